#include "v4l2.h"

#include <algorithm>
#include <memory>
#include <new>

#include "camera.h"
#include "controls.h"
#include "devices.h"
#include "drivers/pixels/convert.h"
#include "drivers/pixels/explain.h"
#include "open.h"

using namespace sphc::v4l2;
using sphc::pixels::explain;

struct sphc_v4l2 {
  explicit sphc_v4l2(const Syscalls &syscalls) : camera(syscalls) {}
  ~sphc_v4l2() { camera.stop(); }

  Camera camera;
};

namespace {

sphc_status checkConfig(const sphc_v4l2_config &config, sphc_message *message) {
  const auto refuse = [&](const char *text) { return explain(message, SPHC_E_ARGUMENT, "config.%s", text); };
  const bool is_depth = config.stream == SPHC_STREAM_DEPTH;
  if (!is_depth && config.stream != SPHC_STREAM_COLOR) return refuse("stream: must be COLOR or DEPTH");
  if (!sphc::pixels::isDelivered(config.format) || (config.format == SPHC_FORMAT_DEPTH16) != is_depth)
    return refuse("format: must be GRAY8, RGB8 or BGR8 of a colour stream, DEPTH16 of a depth stream");
  if (std::min(config.width, config.height) < SPHC_CAMERA_MIN_PX ||
      std::max(config.width, config.height) > SPHC_CAMERA_MAX_PX)
    return explain(message, SPHC_E_ARGUMENT, "config.width, height: must be %u to %u", SPHC_CAMERA_MIN_PX,
                   SPHC_CAMERA_MAX_PX);
  if (config.fps > 1000) return refuse("fps: must be 0 to 1000");
  for (const uint32_t fourcc : config.fourccs) {
    const PixelFormat *format = fourcc ? findPixelFormat(fourcc) : nullptr;
    if (fourcc && (!format || format->stream != config.stream))
      return explain(message, SPHC_E_ARGUMENT,
                     "config.fourccs: %s is no %s layout that this driver knows; leave it 0 for any",
                     fourccText(fourcc).text, is_depth ? "depth" : "colour");
  }
  if (config.buffers < 3 || config.buffers > SPHC_V4L2_MAX_BUFFERS) return refuse("buffers: must be 3 to 32");
  if (config.loan_limit < 2 || config.loan_limit >= config.buffers)
    return refuse("loan_limit: must be 2 to buffers - 1, so that the device always has one");
  return SPHC_OK;
}

// The caller's config or the defaults, complete.
sphc_status chooseConfig(const sphc_v4l2_config *config, sphc_v4l2_config *chosen, sphc_message *message) {
  sphc_v4l2_config_init(chosen, sizeof *chosen);
  if (config && config->struct_size != sizeof *config)
    return explain(message, SPHC_E_STRUCT_SIZE,
                   "config.struct_size is none this library knows; use sphc_v4l2_config_init");
  if (config) *chosen = *config;
  if (chosen->format == 0)
    chosen->format = chosen->stream == SPHC_STREAM_DEPTH ? SPHC_FORMAT_DEPTH16 : SPHC_FORMAT_GRAY8;
  return checkConfig(*chosen, message);
}

Camera *cameraOf(void *self) { return static_cast<Camera *>(self); }

sphc_status startCamera(void *self) { return self ? cameraOf(self)->start() : SPHC_E_ARGUMENT; }
sphc_status acquireFrom(void *self, uint32_t timeout_us, sphc_capture *capture) {
  return self ? cameraOf(self)->acquire(timeout_us, capture) : SPHC_E_ARGUMENT;
}
void releaseTo(void *self, const sphc_capture *capture) {
  if (self && capture) cameraOf(self)->release(*capture);
}
void stopCamera(void *self) {
  if (self) cameraOf(self)->stop();
}
const char *messageOf(const void *self) {
  return self ? static_cast<const Camera *>(self)->message() : "self is null";
}

}  // namespace

namespace sphc::v4l2 {

sphc_status openCamera(const Syscalls &syscalls, const char *camera, const sphc_v4l2_config *config,
                       sphc_v4l2 **v4l2, sphc_message *message) {
  if (!camera || !v4l2) return explain(message, SPHC_E_ARGUMENT, "camera or v4l2 is null; give both");
  sphc_v4l2_config chosen;
  sphc_status status = chooseConfig(config, &chosen, message);
  if (status < 0) return status;
  NodePath found;
  if (isNamedByProperty(camera)) {
    status = findNode(syscalls, camera, chosen.stream, &found, message);
    if (status < 0) return status;
    camera = found.text;
  }
  std::unique_ptr<sphc_v4l2> opened(new (std::nothrow) sphc_v4l2(syscalls));
  if (!opened) return explain(message, SPHC_E_DEVICE, "out of memory; free some");
  sphc_message text = {};  // a try that fails before one that does not leaves no message
  status = opened->camera.open(camera, chosen, &text);
  if (status < 0) return explain(message, status, "%s", text.text);
  *v4l2 = opened.release();
  return SPHC_OK;
}

}  // namespace sphc::v4l2

extern "C" {

sphc_status sphc_v4l2_config_init(sphc_v4l2_config *config, size_t struct_size) {
  if (!config) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *config) return SPHC_E_STRUCT_SIZE;
  *config = {};
  config->struct_size = sizeof *config;
  config->stream = SPHC_STREAM_COLOR;
  config->width = 640;
  config->height = 480;
  config->fps = 30;
  config->buffers = 6;
  config->loan_limit = 3;
  return SPHC_OK;
}

sphc_status sphc_v4l2_list(sphc_v4l2_device *devices, uint32_t capacity, uint32_t *count) {
  if (!count || (!devices && capacity > 0)) return SPHC_E_ARGUMENT;
  listDevices(kLinux, devices, capacity, count);
  return SPHC_OK;
}

sphc_status sphc_v4l2_open(const char *camera, const sphc_v4l2_config *config, sphc_v4l2 **v4l2,
                           sphc_message *message) {
  return openCamera(kLinux, camera, config, v4l2, message);
}

void sphc_v4l2_close(sphc_v4l2 **v4l2) {
  if (!v4l2) return;
  delete *v4l2;
  *v4l2 = nullptr;
}

sphc_status sphc_v4l2_source(sphc_v4l2 *v4l2, sphc_source *source) {
  if (!v4l2 || !source) return SPHC_E_ARGUMENT;
  Camera &camera = v4l2->camera;
  *source = {sizeof *source, camera.loanLimit(), &camera,    startCamera,
             acquireFrom,    releaseTo,          stopCamera, messageOf};
  return SPHC_OK;
}

sphc_status sphc_v4l2_get_mode(const sphc_v4l2 *v4l2, sphc_v4l2_mode *mode) {
  if (!v4l2 || !mode) return SPHC_E_ARGUMENT;
  if (mode->struct_size != sizeof *mode) return SPHC_E_STRUCT_SIZE;
  v4l2->camera.getMode(mode);
  return SPHC_OK;
}

sphc_status sphc_v4l2_get_stats(const sphc_v4l2 *v4l2, sphc_v4l2_stats *stats) {
  if (!v4l2 || !stats) return SPHC_E_ARGUMENT;
  if (stats->struct_size != sizeof *stats) return SPHC_E_STRUCT_SIZE;
  *stats = v4l2->camera.stats();
  stats->struct_size = sizeof *stats;
  return SPHC_OK;
}

sphc_status sphc_v4l2_dmabuf(sphc_v4l2 *v4l2, const sphc_capture *capture, int32_t *fd) {
  return v4l2 && capture && fd ? v4l2->camera.dmabuf(*capture, fd) : SPHC_E_ARGUMENT;
}

sphc_status sphc_v4l2_list_controls(sphc_v4l2 *v4l2, sphc_v4l2_control *controls, uint32_t capacity,
                                    uint32_t *count, sphc_message *message) {
  if (!v4l2 || !count || (!controls && capacity > 0))
    return explain(message, SPHC_E_ARGUMENT, "v4l2, controls or count is null; give all");
  return listControls(v4l2->camera.node(), controls, capacity, count, message);
}

sphc_status sphc_v4l2_find_control(sphc_v4l2 *v4l2, const char *name, sphc_v4l2_control *control,
                                   sphc_message *message) {
  if (!v4l2 || !name || !control)
    return explain(message, SPHC_E_ARGUMENT, "v4l2, name or control is null; give all");
  return findControl(v4l2->camera.node(), name, control, message);
}

sphc_status sphc_v4l2_get_control(sphc_v4l2 *v4l2, uint32_t id, int64_t *value, sphc_message *message) {
  if (!v4l2 || !value) return explain(message, SPHC_E_ARGUMENT, "v4l2 or value is null; give both");
  return getControl(v4l2->camera.node(), id, value, message);
}

sphc_status sphc_v4l2_set_control(sphc_v4l2 *v4l2, uint32_t id, int64_t value, sphc_message *message) {
  if (!v4l2) return explain(message, SPHC_E_ARGUMENT, "v4l2 is null; give one");
  return setControl(v4l2->camera.node(), id, value, message);
}

}  // extern "C"
