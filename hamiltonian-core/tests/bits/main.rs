//! Members of ensembles have the bits of lone runs, on every CPU. `.ci/run` has this test for aarch64 as well.

mod members;
