#!/bin/sh
# The main job end to end, on a fresh Debian 12: install what is missing, build, record a walk with the simulated
# headset, make a sphere cloud of its first lap, localize the second lap in it, write pictures and a report.
# Everything goes to out/quickstart.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
out=out/quickstart
step() { printf '\n== %s\n' "$1"; }

step "1/5 packages"
toolchains/install_packages.sh build run

step "2/5 build"
cmake --preset release -DSPHC_TESTS=OFF -DSPHC_EXAMPLES=OFF >/dev/null
cmake --build --preset release
spherecloud=build/release/sdk/host/cli/spherecloud

rm -rf "$out"
mkdir -p "$out"
step "3/5 a walk with the simulated headset"
"$spherecloud" simulate --out "$out/walk" --frames 200 --rate 6.25

step "4/5 a sphere cloud of the first lap, eta 33 %"
"$spherecloud" build --recording "$out/walk" --last 99 --map "$out/room.sphc" --eta 0.33

step "5/5 the second lap, localized"
"$spherecloud" localize --recording "$out/walk" --first 100 --map "$out/room.sphc" \
  --owner-note "$out/room.sphc.owner.json" --report "$out/report"

printf '\nLook at %s first; the pictures lie beside it.\n' "$root/$out/report/report.html"
