# recorded_files FOLDER: what of a recording goes into the guest, as make_initramfs.sh takes it.
recorded_files() {
  for file in color.yuyv depth.z16 cameras.bin room.sphc poses.bin; do echo "$1/$file=/recorded/$file"; done
}
