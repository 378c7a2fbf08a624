#!/usr/bin/env bash
# Runs the examples and puts their pictures, made small, into the book.
set -euo pipefail
cd "$(dirname "$0")/.."
to=book/src/images
mkdir -p "$to"
large=0
while read -r name example picture size; do
    # More members than by default, where a size is given.
    cargo run --release --quiet --example "$example" -- ${size:+"$size"} > /dev/null
    python3 scripts/compact_svg.py "target/$example/$picture" "$to/$name.svg"
    bytes=$(wc -c < "$to/$name.svg")
    if [ "$bytes" -gt 51200 ]; then
        echo "$name.svg has $bytes bytes; the book takes 51200 at most" >&2
        large=1
    fi
done << 'LIST'
henon_heiles henon_heiles section.svg
kerr kerr torus.svg
driven_pendulum driven_pendulum section.svg
double_pendulum double_pendulum paths.svg
dipole dipole meridian.svg
fput fput modes.svg
nbody_eight nbody eight.svg
nbody_collapse nbody collapse.svg
stars stars merger.svg 10000
chaos_map chaos_map map.svg 40000
basins basins basins.svg 40000
phi4 phi4 fronts.svg 2
breather breather rings.svg
mixing mixing t5.svg 10000
nls nls peaks.svg
rigid_body rigid_body axis.svg
schwarzschild schwarzschild orbits.svg
sweep sweep ends.svg 8000
solar_system solar_system resonance.svg
three_body three_body orbit.svg
toda toda solitons.svg
vortices vortices paths.svg
wisdom_holman wisdom_holman energy.svg
paper_pendulum paper figure1.svg
paper_short paper figure2.svg
paper_long paper figure3.svg
paper_far paper figure4.svg
work_precision_34 work_precision paper34_energy.svg
work_precision_schwarzschild work_precision schwarzschild_energy.svg
LIST
exit "$large"
