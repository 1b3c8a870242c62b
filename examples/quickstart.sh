#!/usr/bin/env bash
# From nothing to a report with pictures: installs what is missing, builds, records a walk with the simulated headset,
# finds where the frames of its first lap were taken from, makes a map of them, and localizes its second lap in it.
# The simulated poses are used only to score.
#
#     examples/quickstart.sh
#
# Made for Debian 12 and its relatives; takes a few minutes.  The command that it builds knows recordings and the simulated
# headset; `cmake --preset release` builds drivers of cameras too.  Everything it makes lies in build/quickstart and
# out/quickstart; run it again at will.
set -euo pipefail

if [ $# != 0 ]; then # it has no options
  [[ $1 = -h || $1 = --help ]] || exec >&2
  sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
  [[ $1 = -h || $1 = --help ]] && exit 0
  printf '\nquickstart: takes no arguments, and there is "%s"\n' "$1"
  exit 2
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/quickstart
out=$root/out/quickstart
steps=6
begin=$SECONDS

bold='' plain=''
if [ -t 1 ]; then bold=$'\033[1m' plain=$'\033[0m'; fi

fail() {
  printf '\nquickstart: %s\n' "$1" >&2
  exit 1
}

step=0
step() {
  step=$((step + 1))
  step_begin=$SECONDS
  printf '%s[%d/%d] %s%s\n' "$bold" "$step" "$steps" "$1" "$plain"
}

finished() { printf '      done in %d s\n' $((SECONDS - step_begin)); }

# Runs a command that reports its own progress on a terminal; elsewhere its words go to a log, shown on failure.
run_logged() {
  local log=$1
  shift
  if [ -t 1 ]; then
    "$@" || fail "this command failed, see above: $*"
  else
    "$@" >"$log" 2>&1 || { tail -n 40 "$log" >&2; fail "this command failed: $* (all it said: $log)"; }
  fi
}

configure_and_build() {
  # A compiler cache serves every checkout.
  export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
  # The command alone, without drivers of devices, several files as one; what it computes is the same at any level of
  # optimisation.
  (cd "$root" && run_logged "$out/configure.log" cmake --preset release -B "$build" -DSPHC_TESTS=OFF -DSPHC_LAB=OFF \
    -DSPHC_EXAMPLES=OFF -DSPHC_DRIVER_LIBCAMERA=OFF -DSPHC_DRIVER_OPENNI2=OFF -DSPHC_DRIVER_V4L2=OFF \
    -DSPHC_UNITY=ON "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG")
  NINJA_STATUS='      [%f/%t] ' run_logged "$out/build.log" cmake --build "$build" --target spherecloud_cli
}

rm -rf "$out"
mkdir -p "$out"
spherecloud=$build/sdk/host/cli/spherecloud

step "Packages"
"$root/toolchains/install_packages.sh" runtime build
finished

step "Build"
configure_and_build
finished

step "Record: two laps of a simulated headset through a furnished room"
"$spherecloud" simulate --out "$out/walk" --frames 200 --rate 6.25 >"$out/simulate.log" ||
  fail "the recording failed, see above"
finished

step "Map: where each frame of lap one was taken from, by images and depths alone"
"$spherecloud" map --recording "$out/walk" --last 99 --model "$out/room.model" --score >"$out/map.txt" ||
  { cat "$out/map.txt"; fail "mapping failed, see above"; }
sed '/^$/,$d; s/^/    /' "$out/map.txt"
finished

step "Release: the model becomes a sphere cloud, one direction in three real"
"$spherecloud" build --model "$out/room.model" --map "$out/room.sphc" |
  sed "s|$root/||; s|^|      |" || fail "making the map failed, see above"
finished

step "Localize: lap two, frame by frame"
echo
"$spherecloud" localize --recording "$out/walk" --first 100 --map "$out/room.sphc" \
  --owner-note "$out/room.sphc.owner.json" --align --trajectory "$out/path.tum" --report "$out/report" >"$out/table.txt" ||
  { cat "$out/table.txt"; fail "localizing failed, see above"; }
sed '/^$/,$d' "$out/table.txt"
echo
finished

cat <<END

${bold}All done in $((SECONDS - begin)) s.${plain} Look at
  $out/report/report.html   all of it on one page
  $out/report/              the pictures one by one
  $out/walk/rgb/            what the headset saw
Next: $build/sdk/host/cli/spherecloud --help
END
