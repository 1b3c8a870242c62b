#!/bin/bash
# fetch_arm64.sh FOLDER - what a guest of arm64 needs and this machine's packages do not have, unpacked, not installed:
# FOLDER/kernel as fetch_kernel.sh makes it, FOLDER/sysroot with busybox and the libraries that our programs link.
# apt gets a state of its own there, so that the machine's knows of no foreign architecture.
set -euo pipefail
folder=$(realpath -m "$1")
here=$(realpath "$(dirname "$0")")
mkdir -p "$folder"/apt/{lists/partial,archives/partial}
touch "$folder/apt/status"
cat >"$folder/apt/apt.conf" <<END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "root";
Dir::Cache "$folder/apt";
Dir::State "$folder/apt";
Dir::State::Lists "$folder/apt/lists";
Dir::State::status "$folder/apt/status";
END
export APT_CONFIG=$folder/apt/apt.conf
"$here/fetch_kernel.sh" arm64 "$folder/kernel"

packages="busybox-static libhwy-dev libhwy1 libturbojpeg0 libturbojpeg0-dev"
[ "$(cat "$folder/sysroot/packages" 2>/dev/null)" != "$packages" ] || exit 0
rm -rf "$folder/sysroot"
mkdir -p "$folder/sysroot"
cd "$folder/apt"
# shellcheck disable=SC2086 # a list of words on purpose
apt-get download -qq $packages
for file in *.deb; do dpkg-deb -x "$file" "$folder/sysroot"; done
rm ./*.deb
echo "$packages" >"$folder/sysroot/packages"
