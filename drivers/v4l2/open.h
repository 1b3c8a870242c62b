// Opening behind a table of system calls; sphc_v4l2_open and sphc_v4l2_list give the real one.
#pragma once

#include "syscalls.h"
#include "v4l2.h"

namespace sphc::v4l2 {

// `syscalls` is borrowed until sphc_v4l2_close.
sphc_status openCamera(const Syscalls &syscalls, const char *camera, const sphc_v4l2_config *config,
                       sphc_v4l2 **v4l2, sphc_message *message);

}  // namespace sphc::v4l2
