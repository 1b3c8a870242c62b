#!/bin/bash
# fetch_kernel.sh amd64 FOLDER - Debian's stock kernel with its media and USB modules, unpacked, not installed.
# FOLDER gets vmlinux (bare, which boots without unpacking itself: 5 s less in an emulator), version and lib/modules.
set -euo pipefail
architecture=$1
folder=$(realpath -m "$2")

# Of a list that is too old apt knows neither the package nor where it lies.
package_of() { apt-cache depends "linux-image-$architecture" 2>/dev/null | awk '/Depends: linux-image/ { print $2; exit }'; }
package=$(package_of)
[ -n "$package" ] || { apt-get update -qq && package=$(package_of); }
version=${package#linux-image-}
[ "$(cat "$folder/version" 2>/dev/null)" != "$version" ] || exit 0

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
apt-get download -qq "$package" 2>/dev/null || { apt-get update -qq && apt-get download -qq "$package"; }
dpkg-deb --fsys-tarfile "$package"_*.deb | tar -x --wildcards './boot/vmlinuz-*' './lib/modules/*/modules.*' \
  './lib/modules/*/kernel/drivers/media/*' './lib/modules/*/kernel/drivers/usb/*'
rm "$package"_*.deb
/sbin/depmod -b . "$version" 2>/dev/null

# The kernel lies xz-compressed in the boot image, behind a stub; the first place that unpacks to an ELF file is it.
for offset in $(grep -abo $'\xfd7zXZ' "boot/vmlinuz-$version" | cut -d: -f1); do
  tail -c "+$((offset + 1))" "boot/vmlinuz-$version" | xz -dc --single-stream 2>/dev/null >vmlinux || true
  [ "$(head -c 4 vmlinux | tail -c 3)" != ELF ] || break
done
[ "$(head -c 4 vmlinux | tail -c 3)" = ELF ] || { echo "no kernel in vmlinuz-$version" >&2; exit 1; }
rm -r boot
echo "$version" >version
