#!/bin/bash
# make_initramfs.sh OUT KERNEL "MODULE..." SCRIPT [FILE[=PLACE]]... - an initial file system in which SCRIPT runs.
# It holds busybox, the modules of the kernel that fetch_kernel.sh got with all they need, in order, and the FILEs with
# their shared libraries (PLACE: /bin/NAME); those of another architecture must be named.  BUSYBOX: another one than this
# machine's.
set -euo pipefail
out=$(realpath -m "$1") kernel=$(realpath "$2") modules=$3 script=$4
shift 4
version=$(cat "$kernel/version")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root"/{bin,dev,etc,lib/modules,proc,run,sbin,sys,tmp,usr/lib}
cp "${BUSYBOX:-/usr/bin/busybox}" "$root/bin/busybox"
cp "$script" "$root/test.sh"
cp "$(dirname "$0")/in_guest/steps.sh" "$root/steps.sh"
cp "$(dirname "$0")/in_guest/init.sh" "$root/init"
chmod +x "$root/init"

for module in $modules; do
  /sbin/modprobe -d "$kernel" -S "$version" --show-depends "$module" | awk '/^insmod/ { print $2 }'
done | awk '!seen[$0]++' | while read -r path; do
  cp "$path" "$root/lib/modules/"
  basename "$path" >>"$root/lib/modules/order"
done

copy() { # FILE PLACE
  mkdir -p "$root$(dirname "$2")"
  [ -e "$root$2" ] || cp -L "$1" "$root$2"
}
for entry in "$@"; do
  file=${entry%%=*} place=${entry#*=}
  [ "$place" != "$file" ] || place=/bin/$(basename "$file")
  copy "$file" "$place"
  libraries=$(ldd "$file" 2>/dev/null | grep -oE '/[^ ]+' || true)  # none of a static program or a script
  for library in $libraries; do copy "$library" "$library"; done
done

(cd "$root" && find . | cpio -o -H newc --quiet | gzip -1) >"$out.part"
mv "$out.part" "$out"
