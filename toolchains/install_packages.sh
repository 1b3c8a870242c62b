#!/bin/sh
# install_packages.sh SECTION... - installs what is missing of these sections of packages.txt (Debian).
set -eu
list=$(dirname "$0")/packages.txt
sections=$(sed -n 's/^\[\(.*\)\]$/\1/p' "$list" | tr '\n' ' ')
if [ $# = 0 ]; then
  echo "usage: install_packages.sh SECTION...; sections: $sections" >&2
  exit 2
fi
for section in "$@"; do
  grep -qxF "[$section]" "$list" || {
    echo "install_packages.sh: there is no section \"$section\"; sections: $sections" >&2
    exit 2
  }
done
command -v dpkg-query >/dev/null || {
  echo "this is no Debian; install by hand what $list names" >&2
  exit 1
}
missing=""
for section in "$@"; do
  for package in $(awk -v section="[$section]" '/^\[/ { inside = $1 == section; next } /^[a-z]/ && inside' "$list"); do
    dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
  done
done
[ -n "$missing" ] || exit 0
as_root=""
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || {
    echo "packages are missing and there is no sudo; as root run: apt-get install --no-install-recommends$missing" >&2
    exit 1
  }
  as_root=sudo
fi
echo "      installing:$missing"
$as_root apt-get update -qq
# shellcheck disable=SC2086 # a list of words on purpose
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
