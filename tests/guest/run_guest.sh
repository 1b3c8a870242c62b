#!/bin/bash
# run_guest.sh KERNEL INITRAMFS LOG [QEMU-OPTION...] - boots, and exits with the status that the guest's test gave;
# 125 when it gave none.  Only the emulator's own CPU: what /dev/kvm offers differs from machine to machine.  The file
# system, 300 MB with all libraries, may take half of the memory that kernel and archive leave.
set -uo pipefail
kernel=$1 initramfs=$2 log=$3
shift 3
if [ "$(cat "$kernel/architecture")" = arm64 ]; then
  machine=(qemu-system-aarch64 -M virt -cpu cortex-a57) console=ttyAMA0
else
  machine=(qemu-system-x86_64 -M q35 -cpu max) console=ttyS0
fi
timeout "${GUEST_TIMEOUT_S:-150}" "${machine[@]}" -accel tcg -m 1280 -smp 1 -nodefaults -nographic -no-reboot -serial stdio \
  -kernel "$kernel/vmlinux" -initrd "$initramfs" -append "console=$console quiet panic=-1 mitigations=off" "$@" \
  >"$log" 2>&1 </dev/null
status=$(tr -d '\r' <"$log" | sed -n 's/^@@RC //p' | tail -n 1)
[ "${status:-125}" = 0 ] || { tail -n 200 "$log"; echo "the guest's status: ${status:-none}; all it said: $log"; }
exit "${status:-125}"
