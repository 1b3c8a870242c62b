#!/bin/busybox sh
# The guest's first process: mounts, modules, the test, its exit status on the serial port, power off.
/bin/busybox --install -s /bin
export PATH=/bin:/sbin:/usr/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
mount -t tmpfs tmp /tmp
for module in $(cat /lib/modules/order); do insmod "/lib/modules/$module" || echo "insmod $module failed"; done
sh /test.sh
echo "@@RC $?"
sync
poweroff -f
