#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>

#include "drivers/v4l2/open.h"
#include "tests/fuzz/targets.h"
#include "tests/support/fake_v4l2.h"

namespace sphc::fuzz {
namespace {

constexpr uint32_t kCameraWidth = 32, kCameraHeight = 16;

// The fake kernel, lying: of each two bytes one says whether and where the next answer is wrong, one how.
struct Liar {
  test::FakeKernel kernel;
  const uint8_t *data;
  size_t bytes, at = 0;

  uint8_t next() { return at < bytes ? data[at++] : 0; }

  static int ioctl(void *self, int fd, unsigned long request, void *argument) {
    Liar &liar = *static_cast<Liar *>(self);
    const v4l2::Syscalls &honest = liar.kernel.syscalls();
    const uint8_t where = liar.next(), how = liar.next();
    if (where == 255) {
      errno = how;
      return -1;
    }
    const int result = honest.ioctl(honest.self, fd, request, argument);
    const size_t size = _IOC_SIZE(request);
    if (where != 0 && size != 0 && request != VIDIOC_EXPBUF) static_cast<uint8_t *>(argument)[where % size] ^= how;
    return result;
  }

  v4l2::Syscalls syscalls() {
    v4l2::Syscalls calls = {};
    calls.self = this;
    calls.open = [](void *self, const char *path, int flags) { return on(self).open(honest(self), path, flags); };
    calls.close = [](void *self, int fd) { return on(self).close(honest(self), fd); };
    calls.ioctl = ioctl;
    calls.mmap = [](void *self, size_t size, int protection, int flags, int fd, int64_t offset) {
      return on(self).mmap(honest(self), size, protection, flags, fd, offset);
    };
    calls.munmap = [](void *self, void *memory, size_t size) {
      return on(self).munmap(honest(self), memory, size);
    };
    calls.poll = [](void *self, pollfd *file, int64_t timeout_ns) {
      return on(self).poll(honest(self), file, timeout_ns);
    };
    calls.nowNs = [](void *self) { return on(self).nowNs(honest(self)); };
    return calls;
  }

  static const v4l2::Syscalls &on(void *self) { return static_cast<Liar *>(self)->kernel.syscalls(); }
  static void *honest(void *self) { return on(self).self; }
};

// A sanitizer sees what lies outside.
void readAll(const sphc_image &image) {
  const uint32_t pixel_bytes = image.format == SPHC_FORMAT_DEPTH16 ? 2 : 1;
  for (uint32_t y = 0; y < image.height; ++y) {
    const auto *row = static_cast<const volatile uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    for (uint32_t i = 0; i < pixel_bytes * image.width; ++i) static_cast<void>(row[i]);
  }
}

void captureSome(const sphc_source &source) {
  int64_t last_ns = INT64_MIN;
  for (int i = 0; i < 10; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = source.acquire(source.self, 50000, &capture);
    if (status != SPHC_OK) {
      if (!source.message(source.self)[0]) broken("every answer but a capture explains itself");
      continue;
    }
    if (capture.time_ns <= last_ns) broken("time goes on");
    last_ns = capture.time_ns;
    accept();
    readAll(capture.image);
    if (i % 2) source.release(source.self, &capture);
  }
}

void runCamera(Liar &liar, uint32_t fourcc, sphc_stream stream) {
  liar.kernel.plugIn(0, test::FakeCamera({{fourcc, kCameraWidth, kCameraHeight, 30}}));
  const v4l2::Syscalls syscalls = liar.syscalls();
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = stream;
  config.width = kCameraWidth;
  config.height = kCameraHeight;
  config.allow_adjusting = liar.next() & 1;
  sphc_v4l2 *camera = nullptr;
  sphc_message message = {};
  const sphc_status status = v4l2::openCamera(syscalls, "card=Fake camera", &config, &camera, &message);
  if (status > 0 || (status < 0) != (message.text[0] != '\0')) broken("a refusal explains itself");
  if ((status < 0) != (camera == nullptr)) broken("a handle when it is open, and only then");
  if (!camera) return;
  sphc_source source;
  sphc_v4l2_source(camera, &source);
  if (source.start(source.self) == SPHC_OK) captureSome(source);
  sphc_v4l2_control control;
  sphc_v4l2_find_control(camera, "Gain", &control, &message);
  source.stop(source.self);
  sphc_v4l2_close(&camera);
}

}  // namespace

void v4l2(const uint8_t *data, size_t bytes) {
  Liar liar = {{}, data, bytes};
  runCamera(liar, V4L2_PIX_FMT_Z16, SPHC_STREAM_DEPTH);
  runCamera(liar, V4L2_PIX_FMT_YUYV, SPHC_STREAM_COLOR);
  if (liar.kernel.openFiles() + liar.kernel.mappings() != 0) broken("everything is closed");
}

}  // namespace sphc::fuzz
