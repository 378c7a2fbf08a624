#!/usr/bin/env bash
# The packages as the registry would have them: each has its licences and its README, and the README's first program is
# built from their archives, in an empty folder.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD

cargo package --workspace --no-verify --allow-dirty --quiet
version=$(sed -n '/^\[workspace.package\]/,/^$/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for archive in target/package/hamiltonian-*-"$version".crate; do
    tar -xzf "$archive" -C "$folder"
done

mkdir -p "$folder/program/src"
manifest=$folder/program/Cargo.toml
printf '[package]\nname = "program"\nedition = "2024"\n[workspace]\n' > "$manifest"
printf '[dependencies]\nhamiltonian-dynamics = "=%s"\n[patch.crates-io]\n' "$version" >> "$manifest"
for package in "$folder"/hamiltonian-*; do
    for file in README.md LICENSE-MIT LICENSE-APACHE; do
        test -s "$package/$file" || { echo "$(basename "$package") lacks $file"; exit 1; }
    done
    name=$(basename "$package" "-$version")
    printf '%s = { path = "../%s-%s" }\n' "$name" "$name" "$version" >> "$manifest"
done

readme=$folder/hamiltonian-dynamics-$version/README.md
listing() { awk -v start="\`\`\`$1" '$0 == start { on = 1; next } /^```$/ && on { exit } on' "$readme"; }
listing rust > "$folder/program/src/main.rs"
cp Cargo.lock "$folder/program"
cd "$folder/program"
printed=$(cargo run --offline --quiet --target-dir "$root/target")
echo "$printed"
test "$printed" = "$(listing text)"
