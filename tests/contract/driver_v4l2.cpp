#include "drivers.h"
#include "drivers/v4l2/open.h"
#include "tests/support/fake_v4l2.h"
#include "tests/support/jpeg_frame.h"

namespace sphc::contract {

namespace {

constexpr uint32_t kWidth = 64, kHeight = 48;

struct OpenCamera {
  ~OpenCamera() { sphc_v4l2_close(&camera); }
  test::FakeKernel kernel;
  sphc_v4l2 *camera = nullptr;
};

OpenedDriver openFake(test::FakeCamera fake, sphc_v4l2_config config) {
  auto opened = std::make_shared<OpenCamera>();
  const auto camera = opened->kernel.plugIn(0, std::move(fake));
  config.width = kWidth;
  config.height = kHeight;
  sphc_message message = {};
  if (v4l2::openCamera(opened->kernel.syscalls(), "/dev/video0", &config, &opened->camera, &message) < 0)
    throw std::runtime_error(message.text);
  OpenedDriver driver{
      {}, opened, [kernel = &opened->kernel] { kernel->unplug(0); }, [camera] { camera->is_stalled = true; }};
  sphc_v4l2_source(opened->camera, &driver.source);
  return driver;
}

sphc_v4l2_config configFor(sphc_stream stream) {
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = stream;
  return config;
}

OpenedDriver openColor() {
  return openFake(test::FakeCamera({{V4L2_PIX_FMT_YUYV, kWidth, kHeight, 30}}), configFor(SPHC_STREAM_COLOR));
}

OpenedDriver openMjpeg() {
  test::FakeCamera fake({{V4L2_PIX_FMT_MJPEG, kWidth, kHeight, 30}});
  const std::vector<uint8_t> jpeg = test::jpegFrame(test::gradientRgb(kWidth, kHeight), kWidth, kHeight);
  fake.paint = [jpeg](test::FakeFrame &frame) {
    frame.bytes_used = static_cast<uint32_t>(jpeg.size());
    std::copy(jpeg.begin(), jpeg.end(), frame.data);
  };
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.format = SPHC_FORMAT_RGB8;
  return openFake(std::move(fake), config);
}

OpenedDriver openDepth(uint32_t export_dmabuf) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  config.export_dmabuf = export_dmabuf;
  return openFake(test::FakeCamera({{V4L2_PIX_FMT_Z16, kWidth, kHeight, 30}}), config);
}

}  // namespace

std::vector<Driver> v4l2Drivers() {
  std::vector<Driver> drivers = {{"V4l2Color", openColor},
                                 {"V4l2Mjpeg", openMjpeg},
                                 {"V4l2Depth", [] { return openDepth(0); }},
                                 {"V4l2DepthByDmabuf", [] { return openDepth(1); }}};
  for (Driver &driver : drivers) {
    driver.streams = 1;
    driver.spare_buffers = 3;  // the kernel's
    driver.is_live = false;
  }
  return drivers;
}

}  // namespace sphc::contract
