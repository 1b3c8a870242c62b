#include "drivers/v4l2/devices.h"

#include <gmock/gmock.h>

#include <cerrno>

#include "opened_camera.h"

namespace sphc::v4l2 {
namespace {

using ::testing::HasSubstr;

std::vector<sphc_v4l2_device> listed(const test::FakeKernel &kernel) {
  std::vector<sphc_v4l2_device> devices(16);
  uint32_t count = 0;
  listDevices(kernel.syscalls(), devices.data(), 16, &count);
  devices.resize(count);
  return devices;
}

// A headset: colour, its metadata, depth, its metadata; a node of another camera in between.
void plugInHeadset(test::FakeKernel &kernel, const std::vector<uint32_t> &numbers, const char *bus = "usb-2") {
  test::FakeCamera color = colorCamera(), depth = depthCamera(), metadata({{0, 64, 48, 30}});
  color.card = depth.card = metadata.card = "Headset";
  color.bus = depth.bus = metadata.bus = bus;
  metadata.caps = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  kernel.plugIn(numbers[0], color);
  kernel.plugIn(numbers[1], metadata);
  kernel.plugIn(numbers[2], depth);
  kernel.plugIn(numbers[3], metadata);
}

TEST(Devices, AreListedWithoutTheirMetadata) {
  test::FakeKernel kernel;
  plugInHeadset(kernel, {0, 1, 4, 5});
  const auto devices = listed(kernel);
  ASSERT_EQ(devices.size(), 2u);
  EXPECT_STREQ(devices[0].node, "/dev/video0");
  EXPECT_STREQ(devices[0].card, "Headset");
  EXPECT_STREQ(devices[0].bus, "usb-2");
  EXPECT_STREQ(devices[0].driver, "fake");
  EXPECT_EQ(devices[0].fourcc_count, 1u);
  EXPECT_EQ(devices[0].fourccs[0], uint32_t{V4L2_PIX_FMT_YUYV});
  EXPECT_TRUE(devices[0].can_color && !devices[0].can_depth);
  EXPECT_STREQ(devices[1].node, "/dev/video4");
  EXPECT_TRUE(devices[1].can_depth && !devices[1].can_color);
  EXPECT_STREQ(devices[1].problem, "");
  EXPECT_EQ(kernel.openFiles(), 0u);
}

TEST(Devices, AreCountedBeyondTheCapacity) {
  test::FakeKernel kernel;
  plugInHeadset(kernel, {0, 1, 4, 5});
  sphc_v4l2_device one = {};
  uint32_t count = 0;
  listDevices(kernel.syscalls(), &one, 1, &count);
  EXPECT_EQ(count, 2u);
  EXPECT_STREQ(one.node, "/dev/video0");
}

TEST(Devices, AreListedWithTheFirstOfManyLayouts) {
  test::FakeKernel kernel;
  std::vector<test::FakeMode> modes;
  for (char letter = '0'; letter < '0' + 60; ++letter)
    modes.push_back({SPHC_V4L2_FOURCC('Q', 'Q', 'Q', letter), kWidth, kHeight, 30});
  modes.push_back({V4L2_PIX_FMT_Z16, kWidth, kHeight, 30});
  kernel.plugIn(0, test::FakeCamera(modes));
  const auto devices = listed(kernel);
  ASSERT_EQ(devices.size(), 1u);
  EXPECT_EQ(devices[0].fourcc_count, 32u);
  EXPECT_EQ(devices[0].fourccs[31], modes[31].fourcc);
  EXPECT_EQ(devices[0].can_depth, 1u) << "though its layout is not among the first";
}

TEST(Devices, AreListedWithTheirProblem) {
  test::FakeKernel kernel;
  kernel.plugIn(0, colorCamera());
  kernel.failRequest(test::FakeKernel::kOpen, EACCES);
  ASSERT_EQ(listed(kernel).size(), 1u);
  kernel.failRequest(test::FakeKernel::kOpen, EACCES);
  EXPECT_THAT(listed(kernel)[0].problem, HasSubstr("group"));
  kernel.failRequest(VIDIOC_QUERYCAP, EIO);
  EXPECT_THAT(listed(kernel)[0].problem, HasSubstr("VIDIOC_QUERYCAP"));
  kernel.failRequest(VIDIOC_ENUM_FMT, EIO);
  EXPECT_THAT(listed(kernel)[0].problem, HasSubstr("VIDIOC_ENUM_FMT"));
}

TEST(Devices, OfTheRealKernelCanBeListed) {
  uint32_t count = 12345;
  EXPECT_EQ(sphc_v4l2_list(nullptr, 0, &count), SPHC_OK);
  EXPECT_NE(count, 12345u);
  EXPECT_EQ(sphc_v4l2_list(nullptr, 1, &count), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_v4l2_list(nullptr, 0, nullptr), SPHC_E_ARGUMENT);
}

TEST(Devices, AreFoundByCardAndBusAndStream) {
  test::FakeKernel kernel;
  kernel.plugIn(0, colorCamera());
  plugInHeadset(kernel, {7, 3, 5, 9});
  EXPECT_STREQ(OpenedCamera(kernel, configFor(SPHC_STREAM_DEPTH), "card=Headset").mode().node, "/dev/video5");
  EXPECT_STREQ(OpenedCamera(kernel, configFor(SPHC_STREAM_COLOR), "bus=usb-2").mode().node, "/dev/video7");
  EXPECT_STREQ(OpenedCamera(kernel, configFor(SPHC_STREAM_COLOR), "bus=usb-fake-1").mode().node, "/dev/video0");
  const OpenedCamera none(kernel, configFor(SPHC_STREAM_DEPTH), "card=Fake camera");
  EXPECT_EQ(none.status, SPHC_E_DEVICE);
  EXPECT_THAT(none.message.text, HasSubstr("no camera card=Fake camera with a depth stream"));
}

TEST(Devices, ThatCannotBeLookedIntoAreNamedWhereNoneIsFound) {
  test::FakeKernel kernel;
  kernel.plugIn(0, colorCamera());
  plugInHeadset(kernel, {1, 2, 3, 4});
  kernel.failRequest(test::FakeKernel::kOpen, EACCES);
  const OpenedCamera refused(kernel, configFor(SPHC_STREAM_COLOR), "card=Fake camera");
  EXPECT_EQ(refused.status, SPHC_E_DEVICE);
  EXPECT_THAT(refused.message.text,
              HasSubstr("/dev/video0 (open: Permission denied; add the user to the node's group"));
  test::FakeCamera planes = depthCamera();
  planes.card = "Bridge";
  planes.caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  kernel.plugIn(5, planes);
  const OpenedCamera bridge(kernel, configFor(SPHC_STREAM_DEPTH), "card=Bridge");
  EXPECT_THAT(bridge.message.text,
              HasSubstr("/dev/video5 (multi-planar, which this driver cannot; use libcamera)"));
  const OpenedCamera other(kernel, configFor(SPHC_STREAM_DEPTH), "card=Nothing");
  EXPECT_THAT(other.message.text, HasSubstr("is it plugged in?")) << "nothing of the bridge's";
}

TEST(Devices, AreFoundAgainUnderAnotherNumber) {
  test::FakeKernel kernel;
  plugInHeadset(kernel, {0, 1, 2, 3});
  std::string name;
  {
    OpenedCamera camera(kernel, configFor(SPHC_STREAM_DEPTH), "/dev/video2");
    name = std::string("bus=") + camera.mode().bus;
    EXPECT_EQ(camera.start(), SPHC_OK);
    for (uint32_t number = 0; number < 4; ++number) kernel.unplug(number);
    sphc_capture capture;
    EXPECT_EQ(camera.acquire(&capture), SPHC_E_DEVICE_LOST);
  }
  plugInHeadset(kernel, {6, 7, 0, 1});
  OpenedCamera camera(kernel, configFor(SPHC_STREAM_DEPTH), name.c_str());
  EXPECT_STREQ(camera.mode().node, "/dev/video0");
  EXPECT_EQ(camera.start(), SPHC_OK);
  camera.take();
}

}  // namespace
}  // namespace sphc::v4l2
