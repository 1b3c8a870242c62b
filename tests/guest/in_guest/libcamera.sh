# The libcamera driver on cameras that the emulator plugs into its USB controller; depth through V4L2 beside it.  libcamera
# wants a controller with an address in the firmware, which the virtual bus has not, and devices that udev knows.
. /steps.sh
/bin/systemd-udevd --daemon
udevadm trigger
udevadm settle -t 10
step "the kernel finds the colour camera" wait_for_node sphc-color
step "the kernel finds the depth camera" wait_for_node sphc-depth
depth=$node
udevadm settle -t 10
step "colour of libcamera, depth of V4L2, and all poses are the recording's" guest_capture --pair libcamera: "v4l2:$depth"
step "unplugging while it captures is a lost device" guest_capture --lost libcamera: color
step "it comes back, under another name" wait_for_node sphc-again
udevadm settle -t 10
step "the same pictures again" guest_capture --ring libcamera: color
dmesg | grep -E 'Oops|BUG: |WARNING: ' && failures=$((failures + 1))
exit "$failures"
