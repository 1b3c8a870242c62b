# The V4L2 driver on the kernel's own UVC driver, with cameras on the virtual bus (vhci_hcd) of the guest.
. /steps.sh
plug_color() { vhci_camera --port "$1" --name sphc-color --format YUYV --size 640x480 --rate 15 --frames /recorded/color.yuyv $2 & camera=$!; }
plug_depth() { vhci_camera --port "$1" --name sphc-depth --format Z16 --size 320x288 --rate 15 --frames /recorded/depth.z16 $2 & camera=$!; }
# The cameras are not in step, so which depth goes with a colour image is chance: it must look at each pair.
example_runs() {
  timeout 100 live_c "$1" "$2" /recorded/calibration.json /recorded/room.sphc 4 >/tmp/example && cat /tmp/example &&
    [ "$(grep -c -e ' at ' -e ' not localized' /tmp/example)" = 4 ]
}

plug_color 0
plug_depth 1
depth_camera=$!
step "the kernel finds the colour camera" wait_for_node sphc-color
color=$node
step "the kernel finds the depth camera" wait_for_node sphc-depth
depth=$node
if [ "$(uname -m)" = x86_64 ]; then  # cameras and kernel without our driver; once is enough
  step "the cameras comply" compliance "$color"
  step "the depth camera complies" compliance "$depth"
  step "YUYV comes through the kernel to the bit" raw_capture "$color" /recorded/color.yuyv
  step "Z16 comes through the kernel to the bit" raw_capture "$depth" /recorded/depth.z16
fi
step "both streams and all poses are the recording's" guest_capture --pair "v4l2:$color" "v4l2:$depth"
if [ -x /bin/live_c ]; then
  step "the example captures, pairs and localizes" example_runs "$color" "$depth"
fi

kill "$depth_camera"
step "an unplugged camera goes" wait_until_gone sphc-depth
plug_depth 2 "--unplug-after 12"
step "a camera comes back" wait_for_node sphc-depth
step "unplugging while it captures is a lost device" guest_capture --lost "v4l2:$node" depth
step "and goes" wait_until_gone sphc-depth
plug_depth 3 "--cut-frame 3"
step "it comes back again" wait_for_node sphc-depth
step "a frame cut short is left out, and all others are the recording's" guest_capture --ring "v4l2:$node" depth
kill "$camera"
step "it goes again" wait_until_gone sphc-depth
plug_depth 4 "--stall-after 5"
step "and comes again" wait_for_node sphc-depth
step "a camera that stalls gives nothing, and nobody hangs" guest_capture --stall "v4l2:$node" depth
dmesg | grep -E 'Oops|BUG: |WARNING: ' && failures=$((failures + 1))
exit "$failures"
