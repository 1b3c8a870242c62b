#include "openni2.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "camera.h"
#include "explain.h"

using namespace sphc::openni2;

struct sphc_openni2 {
  Camera camera;
};

namespace {

constexpr uint32_t kMaxStallUs = 60000000, kMinStallUs = 1000, kMaxOrderWaitUs = 1000000;

// What OpenNI2 lists but for recordings that it has open, given back when done.
class DeviceList {
 public:
  DeviceList() {
    int listed = 0;
    if (oniGetDeviceList(&devices_, &listed) != ONI_STATUS_OK) return;
    count_ = static_cast<uint32_t>(std::remove_if(devices_, devices_ + listed, isFile) - devices_);
  }
  ~DeviceList() {
    if (devices_) oniReleaseDeviceList(devices_);
  }
  DeviceList(const DeviceList &) = delete;
  DeviceList &operator=(const DeviceList &) = delete;
  uint32_t count() const { return count_; }
  const OniDeviceInfo &operator[](uint32_t i) const { return devices_[i]; }

 private:
  static bool isFile(const OniDeviceInfo &info) { return access(info.uri, F_OK) == 0; }

  OniDeviceInfo *devices_ = nullptr;
  uint32_t count_ = 0;
};

sphc_status checkConfig(const sphc_openni2_config &config, sphc_message *message) {
  const auto refuse = [&](const char *text) { return explain(message, SPHC_E_ARGUMENT, "config.%s", text); };
  if (config.streams < 1 || config.streams > 3)
    return refuse("streams: must be SPHC_OPENNI2_STREAM_COLOR, SPHC_OPENNI2_STREAM_DEPTH or both");
  if (config.registration > 1) return refuse("registration: must be 0 or 1");
  if (config.frame_sync > 1) return refuse("frame_sync: must be 0 or 1");
  if (config.loan_limit < 2 || config.loan_limit > kMaxBuffers) return refuse("loan_limit: must be 2 to 64");
  if (config.stall_us < kMinStallUs || config.stall_us > kMaxStallUs)
    return refuse("stall_us: must be 1000 to 60000000");
  if (config.order_wait_us > kMaxOrderWaitUs) return refuse("order_wait_us: must be 0 to 1000000");
  if (config.time_point < SPHC_TIME_MIDDLE || config.time_point > SPHC_TIME_ARRIVAL)
    return refuse("time_point: must be one of SPHC_TIME_");
  if (config.reserved != 0) return refuse("reserved: must be 0");
  return SPHC_OK;
}

// The uri of the first device when none is named.  OpenNI2 is started.
sphc_status chooseDevice(const char *uri, char (&chosen)[ONI_MAX_STR], sphc_message *message) {
  if (uri && std::strlen(uri) >= sizeof chosen)
    return explain(message, SPHC_E_ARGUMENT, "uri: is %zu bytes long; OpenNI2 takes %zu at most", std::strlen(uri),
                   sizeof chosen - 1);
  const DeviceList list;
  if (!uri && list.count() == 0)
    return explain(
        message, SPHC_E_DEVICE,
        "OpenNI2 sees no device: plug it in, look for it in lsusb, and give this user access to its USB node "
        "(a udev rule); one that OpenNI2 does not know needs its maker's plug-in");
  std::strcpy(chosen, uri ? uri : list[0].uri);
  return SPHC_OK;
}

Camera *cameraOf(void *self) { return &static_cast<sphc_openni2 *>(self)->camera; }

sphc_status startCamera(void *self) { return self ? cameraOf(self)->start() : SPHC_E_ARGUMENT; }

sphc_status acquireFromCamera(void *self, uint32_t timeout_us, sphc_capture *capture) {
  return self ? cameraOf(self)->acquire(timeout_us, capture) : SPHC_E_ARGUMENT;
}

void releaseToCamera(void *self, const sphc_capture *capture) {
  if (self && capture) cameraOf(self)->release(*capture);
}

void stopCamera(void *self) {
  if (self) cameraOf(self)->stop();
}

const char *messageOfCamera(const void *self) {
  return self ? static_cast<const sphc_openni2 *>(self)->camera.message() : "self is null";
}

}  // namespace

extern "C" {

sphc_status sphc_openni2_list(sphc_openni2_device *devices, uint32_t capacity, uint32_t *count,
                              sphc_message *message) {
  if (!count || (!devices && capacity != 0))
    return explain(message, SPHC_E_ARGUMENT, "devices or count is null; give both");
  Library library;
  const sphc_status status = library.start(message);
  if (status != SPHC_OK) return status;
  const DeviceList list;
  for (uint32_t i = 0; i < std::min(capacity, list.count()); ++i) devices[i] = publicInfo(list[i]);
  *count = list.count();
  return SPHC_OK;
}

sphc_status sphc_openni2_config_init(sphc_openni2_config *config, size_t struct_size) {
  if (!config) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *config) return SPHC_E_STRUCT_SIZE;
  *config = {};
  config->struct_size = sizeof *config;
  config->streams = SPHC_OPENNI2_STREAM_COLOR | SPHC_OPENNI2_STREAM_DEPTH;
  config->loan_limit = 8;
  config->stall_us = 1000000;
  config->time_point = SPHC_TIME_END;
  return SPHC_OK;
}

sphc_status sphc_openni2_open(const char *uri, const sphc_openni2_config *config, sphc_openni2 **openni2,
                              sphc_message *message) {
  if (!openni2) return explain(message, SPHC_E_ARGUMENT, "openni2 is null; give a pointer to set");
  sphc_openni2_config chosen;
  sphc_openni2_config_init(&chosen, sizeof chosen);
  if (config && config->struct_size != sizeof *config)
    return explain(message, SPHC_E_STRUCT_SIZE,
                   "config.struct_size is none this library knows; use sphc_openni2_config_init");
  if (config) chosen = *config;
  sphc_status status = checkConfig(chosen, message);
  if (status != SPHC_OK) return status;
  sphc_openni2 *opened = new (std::nothrow) sphc_openni2;
  if (!opened) return explain(message, SPHC_E_DEVICE, "out of memory; free some");
  Library library;
  status = library.start(message);
  char its_uri[ONI_MAX_STR];
  if (status == SPHC_OK) status = chooseDevice(uri, its_uri, message);
  if (status == SPHC_OK) status = opened->camera.open(its_uri, chosen, message);
  if (status != SPHC_OK) {
    delete opened;
    return status;
  }
  *openni2 = opened;
  return SPHC_OK;
}

void sphc_openni2_close(sphc_openni2 **openni2) {
  if (!openni2) return;
  delete *openni2;
  *openni2 = nullptr;
}

sphc_status sphc_openni2_get_info(const sphc_openni2 *openni2, sphc_openni2_info *info) {
  if (!openni2 || !info) return SPHC_E_ARGUMENT;
  if (info->struct_size != sizeof *info) return SPHC_E_STRUCT_SIZE;
  *info = openni2->camera.info();
  return SPHC_OK;
}

sphc_status sphc_openni2_source(sphc_openni2 *openni2, sphc_source *source) {
  if (!openni2 || !source) return SPHC_E_ARGUMENT;
  *source = {sizeof *source,    openni2->camera.loanLimit(),
             openni2,           startCamera,
             acquireFromCamera, releaseToCamera,
             stopCamera,        messageOfCamera};
  return SPHC_OK;
}

sphc_status sphc_openni2_get_statistics(const sphc_openni2 *openni2, sphc_openni2_statistics *statistics) {
  if (!openni2 || !statistics) return SPHC_E_ARGUMENT;
  if (statistics->struct_size != sizeof *statistics) return SPHC_E_STRUCT_SIZE;
  openni2->camera.copyCounts(&statistics->color, &statistics->depth);
  statistics->reserved = 0;
  return SPHC_OK;
}

sphc_status sphc_openni2_set_control(sphc_openni2 *openni2, sphc_openni2_control control, int32_t value,
                                     sphc_message *message) {
  if (!openni2) return explain(message, SPHC_E_ARGUMENT, "openni2 is null; give a pointer to set");
  return openni2->camera.device().setControl(control, value, message);
}

sphc_status sphc_openni2_get_control(sphc_openni2 *openni2, sphc_openni2_control control, int32_t *value,
                                     sphc_message *message) {
  if (!openni2 || !value) return explain(message, SPHC_E_ARGUMENT, "openni2 or value is null; give both");
  return openni2->camera.device().getControl(control, value, message);
}

}  // extern "C"
