// The V4L2 driver while the heap is sealed: between opening and closing none of our code may allocate, on good days
// and bad.  (What libjpeg-turbo takes while it decodes is its own, in a shared library, and not seen here.)
#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "drivers/v4l2/open.h"
#include "tests/memory/sealed_heap.h"
#include "tests/support/fake_v4l2.h"
#include "tests/support/jpeg_frame.h"

namespace {

using sphc::test::FakeCamera;
using sphc::test::FakeFrame;
using sphc::test::FakeKernel;

constexpr uint32_t kWidth = 64, kHeight = 48;

void require(bool fine, const char *what) {
  if (fine) return;
  sphc::test::unsealHeap();
  std::fprintf(stderr, "sealed_v4l2: %s\n", what);
  std::exit(1);
}

sphc_status acquire(const sphc_source &source, sphc_capture *capture) {
  *capture = {};
  capture->struct_size = sizeof *capture;
  return source.acquire(source.self, 100000, capture);
}

void captureSome(FakeKernel &kernel, const sphc_source &source, sphc_v4l2 *camera) {
  require(source.start(source.self) == SPHC_OK, "start");
  uint32_t captured = 0;
  for (int i = 0; i < 60; ++i) {
    if (i % 10 == 9) kernel.failRequest(VIDIOC_DQBUF, EIO);
    sphc_capture capture;
    if (acquire(source, &capture) != SPHC_OK) continue;
    ++captured;
    source.release(source.self, &capture);
  }
  require(captured >= 40, "captures");
  int64_t value = 0;
  sphc_message message;
  require(sphc_v4l2_get_control(camera, V4L2_CID_GAIN, &value, &message) == SPHC_E_UNSUPPORTED, "control");
  source.stop(source.self);
}

void runCamera(FakeCamera fake, sphc_stream stream) {
  FakeKernel kernel;
  fake.bend_frame = [](FakeFrame &frame) {
    if (frame.number % 7 == 6) frame.bytes_used /= 2;
    frame.is_lost = frame.number % 11 == 10;
  };
  kernel.plugIn(0, std::move(fake));
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = stream;
  config.width = kWidth;
  config.height = kHeight;
  sphc_v4l2 *camera = nullptr;
  sphc_message message = {};
  const sphc_status status = sphc::v4l2::openCamera(kernel.syscalls(), "/dev/video0", &config, &camera, &message);
  require(status == SPHC_OK, message.text);
  sphc_source source;
  sphc_v4l2_source(camera, &source);

  sphc::test::sealHeap();
  captureSome(kernel, source, camera);
  captureSome(kernel, source, camera);
  require(source.start(source.self) == SPHC_OK, "start before the cable is pulled");
  kernel.unplugAtCall(1);
  sphc_capture capture;
  require(acquire(source, &capture) == SPHC_E_DEVICE_LOST, "unplugged");
  source.stop(source.self);
  sphc::test::unsealHeap();
  sphc_v4l2_close(&camera);
}

}  // namespace

int main() {
  runCamera(FakeCamera({{V4L2_PIX_FMT_Z16, kWidth, kHeight, 30}}), SPHC_STREAM_DEPTH);
  runCamera(FakeCamera({{V4L2_PIX_FMT_YUYV, kWidth, kHeight, 30}}), SPHC_STREAM_COLOR);
  const std::vector<uint8_t> jpeg =
      sphc::test::jpegFrame(sphc::test::gradientRgb(kWidth, kHeight), kWidth, kHeight);
  FakeCamera mjpeg({{V4L2_PIX_FMT_MJPEG, kWidth, kHeight, 30}});
  mjpeg.paint = [&jpeg](FakeFrame &frame) {
    std::copy(jpeg.begin(), jpeg.end(), frame.data);
    frame.bytes_used = static_cast<uint32_t>(jpeg.size());
  };
  runCamera(mjpeg, SPHC_STREAM_COLOR);
  std::puts("nothing was allocated");
  return 0;
}
