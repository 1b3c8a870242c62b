#!/bin/bash
# fetch_kernel.sh amd64|arm64 FOLDER - Debian's stock kernel with its media and USB modules, unpacked, not installed.
# FOLDER gets vmlinux (bare, which boots without unpacking itself: 5 s less in an emulator), version, architecture and
# lib/modules.
set -euo pipefail
architecture=$1
folder=$(realpath -m "$2")

package_of() {
  { apt-cache depends "linux-image-$architecture" 2>/dev/null || true; } |
    awk '/Depends: linux-image/ && !seen { print $2; seen = 1 }'
}
package=$(package_of)
if [ -z "$package" ]; then
  apt-get update -qq
  package=$(package_of)
fi
[ -n "$package" ] || { echo "apt knows no linux-image-$architecture" >&2; exit 1; }
version=${package#linux-image-}
[ "$(cat "$folder/version" "$folder/architecture" 2>/dev/null)" != "$version"$'\n'"$architecture" ] || exit 0

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
apt-get download -qq "$package" 2>/dev/null || { apt-get update -qq && apt-get download -qq "$package"; }
dpkg-deb --fsys-tarfile "$package"_*.deb | tar -x --wildcards './boot/vmlinuz-*' './lib/modules/*/modules.*' \
  './lib/modules/*/kernel/drivers/media/*' './lib/modules/*/kernel/drivers/usb/*'
rm "$package"_*.deb
/sbin/depmod -b . "$version" 2>/dev/null

if [ "$architecture" = amd64 ]; then
  # The kernel lies xz-compressed in the boot image, behind a stub; the first place that unpacks to an ELF file is it.
  for offset in $(grep -abo $'\xfd7zXZ' "boot/vmlinuz-$version" | cut -d: -f1); do
    tail -c "+$((offset + 1))" "boot/vmlinuz-$version" | xz -dc --single-stream 2>/dev/null >vmlinux || true
    [ "$(head -c 4 vmlinux | tail -c 3)" != ELF ] || break
  done
  [ "$(head -c 4 vmlinux | tail -c 3)" = ELF ] || { echo "no kernel in vmlinuz-$version" >&2; exit 1; }
else
  cp "boot/vmlinuz-$version" vmlinux
fi
rm -r boot
echo "$architecture" >architecture
echo "$version" >version
