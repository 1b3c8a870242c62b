#!/bin/bash
# first_pose_in_bare_root.sh [LANGUAGE...] - the command of bindings/README.md in a Debian 12 that has nothing else, for each
# LANGUAGE of c, python, rust, java and csharp, or for all.  It says how long each took, and ends with "N passed, N failed".
# It needs root, debootstrap and Debian's mirror (SPHC_DEBIAN_MIRROR names another one).
set -euo pipefail
all="c python rust java csharp"
root=$(cd "$(dirname "$0")/../.." && pwd)
place=$root/build/bare_root
debian=$place/debian.tar

fail() { printf 'first_pose_in_bare_root.sh: %s\n' "$1" >&2 && exit 2; }

check_arguments() {
  local language
  for language in "$@"; do
    case " $all " in *" $language "*) ;; *) fail "there is no language \"$language\"; there are: $all" ;; esac
  done
}

check_machine() {
  [ "$(id -u)" = 0 ] || fail "only root can change the root folder; run it as root"
  command -v debootstrap >/dev/null || fail "debootstrap is missing; toolchains/install_packages.sh bare_root installs it"
}

# The system, once: $debian is there whole or not at all.
make_debian() {
  [ -f "$debian" ] && return
  local made=$place/made
  rm -rf "$made"
  mkdir -p "$made"
  debootstrap --variant=minbase bookworm "$made" "${SPHC_DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$place/debootstrap.log" 2>&1 ||
    { tail -n 20 "$place/debootstrap.log" >&2 && fail "debootstrap failed; $place/debootstrap.log has all of what it said"; }
  tar -C "$made" -cf "$debian.part" .
  rm -rf "$made"
  mv "$debian.part" "$debian"
}

# bare FOLDER: the system, with the tree as git knows it, edits included.
bare() {
  local tree
  tree=$(git -C "$root" stash create)
  rm -rf "$1"
  mkdir -p "$1/src"
  tar -C "$1" -xf "$debian"
  cp /etc/resolv.conf "$1/etc/resolv.conf"
  git -C "$root" archive "${tree:-HEAD}" | tar -C "$1/src" -x
}

# first_pose FOLDER LANGUAGE: in namespaces of its own, so that mounts and processes end with it, however it ends.
first_pose() {
  # shellcheck disable=SC2016 # for the shell inside
  unshare --mount --pid --fork --kill-child bash -euc '
    mount -t proc proc "$1/proc"
    mount --rbind /dev "$1/dev"
    exec chroot "$1" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
      bash -c "cd /src && bindings/first_pose.sh $2"' first_pose "$1" "$2" </dev/null
}

# The last line with a pose: three numbers side by side.
pose() { grep -E -- '-?[0-9][0-9.e-]*([ ,]+-?[0-9][0-9.e-]*){2}' "$1" | tail -n 1; }

check_arguments "$@"
check_machine
mkdir -p "$place"
make_debian
trap 'rm -rf "$place/root"' EXIT
passed=0 failed=0
for language in ${*:-$all}; do
  log=$place/$language.log
  printf '%-7s ' "$language"
  bare "$place/root"
  begin=$SECONDS
  if first_pose "$place/root" "$language" >"$log" 2>&1 && found=$(pose "$log"); then
    passed=$((passed + 1))
    printf '%4d s  %s\n' $((SECONDS - begin)) "$found"
  else
    failed=$((failed + 1))
    printf '%4d s  FAILED\n' $((SECONDS - begin))
    tail -n 40 "$log"
  fi
done
printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" = 0 ]
