#!/usr/bin/env bash
# The Python package: builds its wheel, of at most 8 MB, installs it into the environment target/python, which it makes if
# it is missing, and runs its tests there. `--tools` makes the environment alone; other arguments are those of pytest.
set -euo pipefail
cd "$(dirname "$0")/.."

python=target/python/bin/python
packages=(maturin matplotlib numpy pytest scipy sympy tqdm xarray zarr)
imports=$(IFS=,; echo "${packages[*]}")
test -x "$python" || python3 -m venv target/python
"$python" -c "import $imports" 2> /dev/null || "$python" -m pip install -q "${packages[@]}"
test "${1-}" = --tools && exit

manifest=hamiltonian-python/Cargo.toml
rm -rf target/wheels
start=$SECONDS
"$python" -m maturin build --release --manifest-path "$manifest" --target-dir target --out target/wheels
wheel=$(ls target/wheels/*.whl)
bytes=$(wc -c < "$wheel")
echo "$wheel: $bytes bytes in $((SECONDS - start)) s"
test "$bytes" -le 8388608 || { echo "the wheel is larger than 8 MB"; exit 1; }

"$python" -m pip install -q --force-reinstall --no-deps "$wheel"
cd hamiltonian-python
"../$python" -m pytest "$@"
