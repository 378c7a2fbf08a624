//! Sets `unoptimised` where this crate is compiled without optimisation: operations of packs are functions then, and
//! nothing of this crate is inlined, so that rustc compiles each function once.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(unoptimised)");
    if std::env::var_os("OPT_LEVEL").is_some_and(|level| level == "0") {
        println!("cargo::rustc-cfg=unoptimised");
    }
}
