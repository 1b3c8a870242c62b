// What cameras are there, and where one that has been plugged in again went.
#pragma once

#include "node.h"
#include "spherecloud/spherecloud_capture.h"
#include "v4l2.h"

namespace sphc::v4l2 {

void listDevices(const Syscalls &syscalls, sphc_v4l2_device *devices, uint32_t capacity, uint32_t *count);

struct NodePath {
  char text[32];
};
// `camera` is "card=NAME" or "bus=PLUG".
sphc_status findNode(const Syscalls &syscalls, const char *camera, sphc_stream stream, NodePath *path,
                     sphc_message *message);
bool isNamedByProperty(const char *camera);

}  // namespace sphc::v4l2
