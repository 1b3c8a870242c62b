#!/bin/bash
# test_libcamera.sh KERNEL RECORDED OUT REDIRECT_CAMERA GUEST_CAPTURE PLUGIN - boots a guest and plugs cameras into the USB
# controller that the emulator gives it.
set -euo pipefail
here=$(dirname "$0")
kernel=$1 recorded=$2 out=$3 redirect_camera=$4 guest_capture=$5 plugin=$6
. "$here/recorded_files.sh"
mkdir -p "$out"
# shellcheck disable=SC2046 # lists of words on purpose
"$here/make_initramfs.sh" "$out/initramfs" "$kernel" "xhci-pci uvcvideo" "$here/in_guest/libcamera.sh" \
  "$guest_capture" "$plugin=/usr/lib/$(basename "$plugin")" /usr/bin/udevadm /usr/bin/udevadm=/bin/systemd-udevd \
  $(recorded_files "$recorded")

sockets=$(mktemp -d)  # their paths must be short
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$sockets"' EXIT
color() {
  "$redirect_camera" --socket "$sockets/color" --format YUYV --size 640x480 --rate 15 \
    --exposure-modes 9 --frames "$recorded/color.yuyv" "$@"
}
{ color --name sphc-color --unplug-after 60 && color --name sphc-again; } &
"$redirect_camera" --socket "$sockets/depth" --name sphc-depth --format Z16 --size 320x288 --rate 15 \
  --frames "$recorded/depth.z16" &
"$here/run_guest.sh" "$kernel" "$out/initramfs" "$out/serial.log" -device qemu-xhci \
  -chardev "socket,id=color,path=$sockets/color,server=on,wait=off" -device usb-redir,chardev=color \
  -chardev "socket,id=depth,path=$sockets/depth,server=on,wait=off" -device usb-redir,chardev=depth
grep -a '@@' "$out/serial.log"
