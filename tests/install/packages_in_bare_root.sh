#!/bin/bash
# packages_in_bare_root.sh BUILD - the Debian packages of a build folder (docs/install.md), installed in a Debian 12 that has
# nothing else: the command maps and localizes, Python finds a pose, and sections of docs/install.md build programs.
# It ends with "N passed, N failed".
set -uo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
passed=0 failed=0

fail() { printf 'packages_in_bare_root.sh: %s\n' "$1" >&2 && exit 2; }
# shellcheck source=tests/support/bare_root.sh
. "$root/tests/support/bare_root.sh"

# step NAME SCRIPT: in the bare root
step() {
  local log=$place/packages.log begin=$SECONDS
  printf '%-28s ' "$1"
  if in_bare "$place/packages" "$2" >"$log" 2>&1; then
    passed=$((passed + 1))
    printf '%4d s  %s\n' $((SECONDS - begin)) "$(tail -n 1 "$log")"
  else
    failed=$((failed + 1))
    printf '%4d s  FAILED\n' $((SECONDS - begin))
    tail -n 40 "$log"
  fi
}

# page NAME SECTION: a section of docs/install.md, done as it says
page() {
  step "$1" "python3 -B /src/tests/install/follow_page.py /src '$2' --folder /tmp/page --prefix /usr --libdir lib --version $version ${3:-}"
}

[ $# = 1 ] || fail "one build folder is wanted, and there are $# words"
[ -f "$1/CPackConfig.cmake" ] || fail "$1 has no CPackConfig.cmake; build the release there first (tests/run.sh release: build/unity)"
check_machine
version=$(sed -n 's/^set(CPACK_PACKAGE_VERSION "\([0-9.]*\).*/\1/p' "$1/CPackConfig.cmake")
mkdir -p "$place"
make_debian
trap 'rm -rf "$place/packages"' EXIT
bare "$place/packages"
cpack --config "$1/CPackConfig.cmake" -B "$place/packages/debs" >"$place/cpack.log" 2>&1 || fail "cpack failed: $(tail -n 3 "$place/cpack.log")"

step "the command" "apt-get update -qq; apt-get install -y --no-install-recommends /debs/libspherecloud[0-9]*.deb /debs/spherecloud-tools*.deb; spherecloud --version"
step "the pages" "apt-get install -y --no-install-recommends /debs/spherecloud-doc*.deb; test -s /usr/share/doc/spherecloud/docs/release.md; echo they are there"
step "a map and its poses" "cd /tmp; spherecloud simulate --frames 12 --rate 3 --out walk; spherecloud build --recording walk --map room.sphc --last 8
  spherecloud localize --recording walk --first 9 --map room.sphc --owner-note room.sphc.owner.json; test -s room.sphc; echo localized"
step "libcamera" "apt-get install -y --no-install-recommends /debs/spherecloud-libcamera*.deb
  ! spherecloud devices 2>&1 | grep libspherecloud_libcamera && echo the command finds the plug-in"
step "Python" "apt-get install -y --no-install-recommends /debs/python3-spherecloud*.deb
  python3 -c 'import spherecloud; print(spherecloud.version())'; python3 -m spherecloud info /tmp/room.sphc; python3 -m spherecloud --version"
step "headers and static library" "apt-get install -y --no-install-recommends gcc g++ make cmake ninja-build pkg-config libc6-dev /debs/libspherecloud-dev*.deb; pkg-config --modversion spherecloud"
page "pkg-config" "pkg-config"
page "make" "make"
page "find_package" "CMake: find_package" --static
page "find_package, shared" "CMake: the shared library"
step "drivers" "apt-get install -y /debs/libspherecloud-drivers-dev*.deb; pkg-config --modversion spherecloud-drivers"
page "the examples, by one line" "The examples: each by one line"
step "removed again" "apt-get purge -y 'libspherecloud*' 'spherecloud*' 'python3-spherecloud*'; ! find /usr -iname '*spherecloud*' | grep . && echo nothing is left"
printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" = 0 ]
