# For the tests in the guest: steps that are counted, and cameras by name.
failures=0

# step WHAT COMMAND...: says whether it went well, and goes on
step() {
  what=$1
  shift
  if "$@"; then echo "@@OK $what at $(cut -d' ' -f1 /proc/uptime) s"; else
    echo "@@FAILED $what"
    failures=$((failures + 1))
  fi
}

# A camera has two nodes; the one of index 0 is the pictures, and their numbers may come in any order.
find_node() {
  for folder in /sys/class/video4linux/video*; do
    grep -qs "$1" "$folder/name" && [ "$(cat "$folder/index")" = 0 ] && echo "/dev/${folder##*/}"
  done
}

# wait_for_node NAME: up to 20 s; sets `node`
wait_for_node() {
  for _ in $(seq 200); do
    node=$(find_node "$1")
    [ -z "$node" ] || return 0
    sleep 0.1
  done
  echo "no camera $1 came"
  return 1
}

wait_until_gone() {
  for _ in $(seq 200); do
    [ -n "$(find_node "$1")" ] || return 0
    sleep 0.1
  done
  echo "camera $1 did not go"
  return 1
}

# raw_capture NODE FILE: without our driver, all the frames of FILE, to the bit
raw_capture() {
  v4l2-ctl -d "$1" --stream-mmap --stream-count=8 --stream-to=/tmp/raw && cmp /tmp/raw "$2"
}

compliance() { v4l2-compliance -d "$1" >/tmp/compliance && grep 'Failed: 0' /tmp/compliance || { cat /tmp/compliance; false; }; }
