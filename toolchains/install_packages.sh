#!/bin/sh
# install_packages.sh KIND... - installs what is missing of the packages of these kinds in packages.txt (Debian).
set -eu
list=$(dirname "$0")/packages.txt
missing=""
for kind in "$@"; do
  for package in $(awk -v kind="$kind" '$1 == kind { print $2 }' "$list"); do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q "install ok installed" || missing="$missing $package"
  done
done
[ -n "$missing" ] || exit 0
command -v apt-get >/dev/null || { echo "these packages are missing and apt-get is not here:$missing" >&2; exit 1; }
as_root=""
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || { echo "run as root, or install by hand:$missing" >&2; exit 1; }
  as_root=sudo
fi
echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
# shellcheck disable=SC2086 # a list on purpose
$as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
