#!/bin/bash
# first_pose_in_bare_root.sh [LANGUAGE...] - the command of bindings/README.md in a Debian 12 that has nothing else, for each
# LANGUAGE of c, python, rust, java and csharp, or for all.  It says how long each took, and ends with "N passed, N failed".
# It needs root, debootstrap and Debian's mirror (SPHC_DEBIAN_MIRROR names another one).
set -euo pipefail
all="c python rust java csharp"
root=$(cd "$(dirname "$0")/../.." && pwd)

fail() { printf 'first_pose_in_bare_root.sh: %s\n' "$1" >&2 && exit 2; }

check_arguments() {
  local language
  for language in "$@"; do
    case " $all " in *" $language "*) ;; *) fail "there is no language \"$language\"; there are: $all" ;; esac
  done
}

# The last line with a pose: three numbers side by side.
pose() { grep -E -- '-?[0-9][0-9.e-]*([ ,]+-?[0-9][0-9.e-]*){2}' "$1" | tail -n 1; }

# shellcheck source=tests/support/bare_root.sh
. "$root/tests/support/bare_root.sh"
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
  if in_bare "$place/root" "cd /src; bindings/first_pose.sh $language" >"$log" 2>&1 && found=$(pose "$log"); then
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
