#!/bin/bash
# test_v4l2.sh KERNEL RECORDED OUT VHCI_CAMERA GUEST_CAPTURE FILE... - boots a guest with cameras on its virtual bus; FILEs
# go into it, as make_initramfs.sh takes them.
set -euo pipefail
here=$(dirname "$0")
kernel=$1 recorded=$2 out=$3 vhci_camera=$4 guest_capture=$5
shift 5
. "$here/recorded_files.sh"
mkdir -p "$out"
# shellcheck disable=SC2046 # a list of words on purpose
"$here/make_initramfs.sh" "$out/initramfs" "$kernel" "vhci-hcd uvcvideo" "$here/in_guest/v4l2.sh" \
  "$vhci_camera" "$guest_capture" "$@" $(recorded_files "$recorded")
"$here/run_guest.sh" "$kernel" "$out/initramfs" "$out/serial.log"
grep -a '@@' "$out/serial.log"
