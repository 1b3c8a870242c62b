#include <gmock/gmock.h>

#include <cerrno>
#include <cstring>

#include "opened_camera.h"

namespace sphc::v4l2 {
namespace {

using ::testing::HasSubstr;

void expectRefused(const std::function<void(sphc_v4l2_config &)> &spoil, const char *text) {
  test::FakeKernel kernel;
  kernel.plugIn(0, colorCamera());
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  spoil(config);
  const OpenedCamera opened(kernel, config);
  EXPECT_EQ(opened.status, SPHC_E_ARGUMENT);
  EXPECT_EQ(opened.handle, nullptr);
  EXPECT_THAT(opened.message.text, HasSubstr(text));
  EXPECT_EQ(kernel.calls(), 0u) << "the device is not touched";
}

TEST(Open, RefusesConfigsThatCannotBe) {
  expectRefused([](sphc_v4l2_config &c) { c.stream = 7; }, "stream");
  expectRefused([](sphc_v4l2_config &c) { c.format = SPHC_FORMAT_DEPTH16; }, "format");
  expectRefused([](sphc_v4l2_config &c) { c.format = SPHC_FORMAT_NV12; }, "format");
  expectRefused([](sphc_v4l2_config &c) { c.stream = SPHC_STREAM_DEPTH, c.format = SPHC_FORMAT_RGB8; }, "format");
  expectRefused([](sphc_v4l2_config &c) { c.width = 15; }, "width");
  expectRefused([](sphc_v4l2_config &c) { c.height = 8193; }, "height");
  expectRefused([](sphc_v4l2_config &c) { c.fps = 1001; }, "fps");
  expectRefused([](sphc_v4l2_config &c) { c.fourccs[1] = SPHC_V4L2_FOURCC('H', '2', '6', '4'); }, "H264");
  expectRefused([](sphc_v4l2_config &c) { c.fourccs[0] = V4L2_PIX_FMT_Z16; }, "Z16");
  expectRefused([](sphc_v4l2_config &c) { c.buffers = 2; }, "buffers");
  expectRefused([](sphc_v4l2_config &c) { c.buffers = 33; }, "buffers");
  expectRefused([](sphc_v4l2_config &c) { c.loan_limit = 1; }, "loan_limit");
  expectRefused([](sphc_v4l2_config &c) { c.loan_limit = c.buffers; }, "loan_limit");
}

TEST(Open, RefusesAnotherStructSizeAndNull) {
  test::FakeKernel kernel;
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.struct_size -= 4;
  EXPECT_EQ(OpenedCamera(kernel, config).status, SPHC_E_STRUCT_SIZE);
  sphc_v4l2 *camera = nullptr;
  EXPECT_EQ(sphc_v4l2_open(nullptr, nullptr, &camera, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_v4l2_open("/dev/video0", nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_v4l2_config_init(nullptr, sizeof config), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_v4l2_config_init(&config, 1), SPHC_E_STRUCT_SIZE);
  sphc_v4l2_close(nullptr);
  sphc_v4l2_close(&camera);
}

TEST(Open, IsOfTheRealKernelToo) {  // no test may need a camera, but a path that is none is none everywhere
  sphc_v4l2 *camera = nullptr;
  sphc_message message = {};
  EXPECT_EQ(sphc_v4l2_open("/dev/null/no_camera", nullptr, &camera, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, HasSubstr("open"));
  EXPECT_EQ(sphc_v4l2_open("/dev/null", nullptr, &camera, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, HasSubstr("VIDIOC_QUERYCAP")) << "not a video device";
}

TEST(Open, ExplainsWhyItCannot) {
  const struct {
    unsigned long request;
    int error;
    sphc_status status;
    const char *cure;
  } cases[] = {{test::FakeKernel::kOpen, ENOENT, SPHC_E_DEVICE, "plugged in?"},
               {test::FakeKernel::kOpen, ENODEV, SPHC_E_DEVICE, "unplugged"},
               {test::FakeKernel::kOpen, EACCES, SPHC_E_DEVICE, "group"},
               {test::FakeKernel::kOpen, EMFILE, SPHC_E_DEVICE, "too many open files"},
               {VIDIOC_QUERYCAP, ENOTTY, SPHC_E_DEVICE, "no video device"},
               {VIDIOC_QUERYCAP, ENODEV, SPHC_E_DEVICE_LOST, "unplugged"},
               {VIDIOC_ENUM_FMT, EIO, SPHC_E_DEVICE, "does not answer"},
               {VIDIOC_S_FMT, EBUSY, SPHC_E_DEVICE, "another program or handle has it"},
               {VIDIOC_S_PARM, EIO, SPHC_E_DEVICE, "does not answer"},
               {VIDIOC_REQBUFS, ENOMEM, SPHC_E_DEVICE, "ask for fewer or smaller"},
               {VIDIOC_QUERYBUF, EINVAL, SPHC_E_DEVICE, "VIDIOC_QUERYBUF"},
               {test::FakeKernel::kMmap, ENOMEM, SPHC_E_DEVICE, "mmap"}};
  for (const auto &fault : cases) {
    test::FakeKernel kernel;
    kernel.plugIn(0, colorCamera());
    kernel.failRequest(fault.request, fault.error);
    const OpenedCamera opened(kernel, configFor(SPHC_STREAM_COLOR));
    EXPECT_EQ(opened.status, fault.status) << opened.message.text;
    EXPECT_THAT(opened.message.text, HasSubstr(fault.cure));
    EXPECT_EQ(opened.handle, nullptr);
    EXPECT_EQ(kernel.openFiles() + kernel.mappings(), 0u) << opened.message.text;
  }
}

TEST(Open, NeedsNoRateControl) {
  test::FakeKernel kernel;
  kernel.plugIn(0, colorCamera());
  kernel.failRequest(VIDIOC_S_PARM, ENOTTY);
  const OpenedCamera opened(kernel, configFor(SPHC_STREAM_COLOR));
  ASSERT_EQ(opened.status, SPHC_OK) << opened.message.text;
  EXPECT_EQ(opened.mode().period_denominator, 0u) << "not told";
}

TEST(Open, RefusesNodesThatCaptureNothingItCanTake) {
  const struct {
    uint32_t caps;
    const char *text;
  } cases[] = {{V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING, "captures no video"},
               {V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING, "multi-planar"},
               {V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE, "cannot stream"}};
  for (const auto &node : cases) {
    test::FakeKernel kernel;
    test::FakeCamera fake = colorCamera();
    fake.caps = node.caps;
    kernel.plugIn(0, std::move(fake));
    const OpenedCamera opened(kernel, configFor(SPHC_STREAM_COLOR));
    EXPECT_EQ(opened.status, SPHC_E_UNSUPPORTED);
    EXPECT_THAT(opened.message.text, HasSubstr(node.text));
  }
}

// A camera that makes `most` buffers of the 6 asked for; 3 loans.
test::FakeCamera withBuffers(uint32_t most, test::FakeCamera fake) {
  fake.most_buffers = most;
  return fake;
}

// Three images at once; those of depth keep the pixels of their own frames.
void expectAllLoans(RunningCamera &running) {
  const sphc_capture loans[] = {running.opened.take(), running.opened.take(), running.opened.take()};
  sphc_capture none;
  EXPECT_EQ(running.opened.acquire(&none), SPHC_E_STATE);
  for (const sphc_capture &loan : loans) {
    if (loan.stream != SPHC_STREAM_DEPTH) continue;
    std::vector<uint8_t> painted(loan.image.stride_bytes * kHeight);
    test::paintPattern(loan.sequence, painted.data(), static_cast<uint32_t>(painted.size()));
    EXPECT_EQ(std::memcmp(loan.image.data, painted.data(), painted.size()), 0) << loan.sequence;
  }
}

TEST(Open, TakesFewBuffersWhereImagesAreConverted) {
  for (const uint32_t most : {2u, 3u, 4u}) {
    RunningCamera running(withBuffers(most, colorCamera()), configFor(SPHC_STREAM_COLOR));
    EXPECT_EQ(running.opened.mode().buffers, most);
    expectAllLoans(running);
  }
}

TEST(Open, CopiesWhereTheBuffersAreTooFewToLend) {
  for (const uint32_t most : {2u, 3u, 4u}) {
    RunningCamera running(withBuffers(most, depthCamera()), configFor(SPHC_STREAM_DEPTH));
    EXPECT_EQ(running.opened.mode().buffers, most);
    EXPECT_EQ(running.opened.mode().zero_copy, most == 4 ? 1u : 0u);
    expectAllLoans(running);
  }
}

TEST(Open, RefusesBuffersThatAreTooFew) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  const auto refused = [&](uint32_t most) {
    test::FakeKernel kernel;
    kernel.plugIn(0, withBuffers(most, depthCamera()));
    const OpenedCamera opened(kernel, config);
    EXPECT_EQ(opened.status, SPHC_E_DEVICE);
    return std::string(opened.message.text);
  };
  EXPECT_THAT(refused(1), HasSubstr("gave 1 buffers of the 6 asked for, and 2 are needed; use another camera"));
  config.export_dmabuf = 1;
  EXPECT_THAT(refused(3),
              HasSubstr("gave 3 buffers of the 6 asked for, and 4 are needed; lower loan_limit or set"));
}

TEST(Open, SaysWhenDmabufsCannotBe) {
  test::FakeKernel kernel;
  kernel.plugIn(0, depthCamera());
  kernel.failRequest(VIDIOC_EXPBUF, ENOTTY);
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  config.export_dmabuf = 1;
  const OpenedCamera opened(kernel, config);
  EXPECT_EQ(opened.status, SPHC_E_UNSUPPORTED);
  EXPECT_THAT(opened.message.text, HasSubstr("set config.export_dmabuf to 0"));
  kernel.failRequest(VIDIOC_EXPBUF, EMFILE);
  const OpenedCamera too_many(kernel, config);
  EXPECT_EQ(too_many.status, SPHC_E_DEVICE) << "the camera can";
  EXPECT_THAT(too_many.message.text, HasSubstr("too many open files; close some"));
}

TEST(Open, ClosesEverything) {
  test::FakeKernel kernel;
  kernel.plugIn(0, depthCamera());
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  config.export_dmabuf = 1;
  {
    OpenedCamera opened(kernel, config);
    EXPECT_EQ(opened.start(), SPHC_OK);
    EXPECT_EQ(kernel.openFiles(), 7u);
    EXPECT_EQ(kernel.mappings(), 6u);
  }
  EXPECT_EQ(kernel.openFiles() + kernel.mappings(), 0u);
}

}  // namespace
}  // namespace sphc::v4l2
