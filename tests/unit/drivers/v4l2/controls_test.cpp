#include <gmock/gmock.h>

#include <cerrno>

#include "opened_camera.h"

namespace sphc::v4l2 {
namespace {

using ::testing::HasSubstr;

constexpr uint32_t kAuto = V4L2_CID_EXPOSURE_AUTO, kExposure = V4L2_CID_EXPOSURE_ABSOLUTE;
constexpr uint32_t kWide = V4L2_CID_IMAGE_PROC_CLASS_BASE + 90;

test::FakeCamera cameraWithControls() {
  test::FakeCamera fake = colorCamera();
  fake.controls = {
      {V4L2_CID_BRIGHTNESS, "Brightness", V4L2_CTRL_TYPE_INTEGER, -64, 64, 1, 0, 0},
      {V4L2_CID_GAIN, "Gain", V4L2_CTRL_TYPE_INTEGER, 0, 100, 5, 20, V4L2_CTRL_FLAG_INACTIVE},
      {V4L2_CID_CAMERA_CLASS, "Camera Controls", V4L2_CTRL_TYPE_CTRL_CLASS, 0, 0, 0, 0, V4L2_CTRL_FLAG_READ_ONLY},
      {kAuto, "Auto Exposure", V4L2_CTRL_TYPE_MENU, 0, 3, 1, V4L2_EXPOSURE_MANUAL, 0},
      {kExposure, "Exposure Time, Absolute", V4L2_CTRL_TYPE_INTEGER, 1, 5000, 1, 80, 0},
      {V4L2_CID_PRIVACY, "Privacy", V4L2_CTRL_TYPE_BOOLEAN, 0, 1, 1, 0, V4L2_CTRL_FLAG_READ_ONLY},
      {kWide, "Wide", V4L2_CTRL_TYPE_INTEGER64, 0, int64_t{1} << 40, 1, int64_t{1} << 36, 0}};
  std::sort(fake.controls.begin(), fake.controls.end(), [](auto &a, auto &b) { return a.id < b.id; });
  return fake;
}

struct Controls : ::testing::Test {
  test::FakeKernel kernel;
  std::shared_ptr<test::FakeCamera> fake = kernel.plugIn(0, cameraWithControls());
  OpenedCamera camera{kernel, configFor(SPHC_STREAM_COLOR)};
  sphc_message message = {};

  int64_t get(uint32_t id) {
    int64_t value = -1;
    EXPECT_EQ(sphc_v4l2_get_control(camera.handle, id, &value, &message), SPHC_OK) << message.text;
    return value;
  }
  sphc_status set(uint32_t id, int64_t value) {
    message = {};
    return sphc_v4l2_set_control(camera.handle, id, value, &message);
  }
};

TEST_F(Controls, AreListedWithoutTheirHeadings) {
  sphc_v4l2_control controls[3] = {};
  uint32_t count = 0;
  ASSERT_EQ(sphc_v4l2_list_controls(camera.handle, controls, 3, &count, &message), SPHC_OK);
  EXPECT_EQ(count, 6u);
  EXPECT_STREQ(controls[0].name, "Brightness");
  EXPECT_EQ(controls[0].minimum, -64);
  EXPECT_EQ(controls[1].is_inactive, 1u);
  EXPECT_EQ(controls[1].step, 5);
}

TEST_F(Controls, AreFoundByNameWhateverItsSpelling) {
  for (const char *name : {"Exposure Time, Absolute", "exposure_time_absolute", "EXPOSURE time absolute "}) {
    sphc_v4l2_control control = {};
    EXPECT_EQ(sphc_v4l2_find_control(camera.handle, name, &control, &message), SPHC_OK) << name;
    EXPECT_EQ(control.id, kExposure);
    EXPECT_EQ(control.maximum, 5000);
  }
  sphc_v4l2_control control = {};
  for (const char *name : {"exposure_time", "exposure_time_absolute_2", "", "Camera Controls"})
    EXPECT_EQ(sphc_v4l2_find_control(camera.handle, name, &control, &message), SPHC_E_UNSUPPORTED) << name;
  EXPECT_THAT(message.text, HasSubstr("no control named Camera Controls"));
}

TEST_F(Controls, AreSetAndRead) {
  EXPECT_EQ(set(V4L2_CID_BRIGHTNESS, -30), SPHC_OK) << message.text;
  EXPECT_EQ(get(V4L2_CID_BRIGHTNESS), -30);
  EXPECT_EQ(get(kWide), int64_t{1} << 36);
  EXPECT_EQ(set(kWide, (int64_t{1} << 36) + 1), SPHC_OK);
  EXPECT_EQ(get(kWide), (int64_t{1} << 36) + 1);
}

TEST_F(Controls, AreNotBentSilently) {
  EXPECT_EQ(set(kExposure, 5001), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("Exposure Time, Absolute is 5001; must be 1 to 5000 in steps of 1"));
  EXPECT_EQ(set(kExposure, INT64_MIN), SPHC_E_ARGUMENT);
  EXPECT_EQ(set(V4L2_CID_GAIN, 5), SPHC_E_STATE) << "automatic";
  fake->findControl(V4L2_CID_GAIN)->flags = 0;
  EXPECT_EQ(set(V4L2_CID_GAIN, 7), SPHC_E_ARGUMENT) << "between two steps";
  EXPECT_EQ(set(V4L2_CID_GAIN, 10), SPHC_OK);
  EXPECT_EQ(set(V4L2_CID_PRIVACY, 1), SPHC_E_UNSUPPORTED);
  EXPECT_THAT(message.text, HasSubstr("read only"));
}

TEST_F(Controls, SayThatAValueInRangeIsNoneOfTheChoices) {  // menus of UVC cameras have holes
  kernel.failRequest(VIDIOC_S_EXT_CTRLS, EINVAL);
  EXPECT_EQ(set(kAuto, V4L2_EXPOSURE_SHUTTER_PRIORITY), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("Auto Exposure does not take 2"));
}

TEST_F(Controls, ThatCanOnlyBeSetAreNotRead) {
  fake->findControl(V4L2_CID_BRIGHTNESS)->flags = V4L2_CTRL_FLAG_WRITE_ONLY;
  kernel.failRequest(VIDIOC_G_EXT_CTRLS, EACCES);
  int64_t value = 77;
  EXPECT_EQ(sphc_v4l2_get_control(camera.handle, V4L2_CID_BRIGHTNESS, &value, &message), SPHC_E_UNSUPPORTED);
  EXPECT_THAT(message.text, HasSubstr("Brightness can only be set"));
  EXPECT_EQ(value, 77);
}

TEST_F(Controls, ThatAreNotThereAreUnsupported) {
  int64_t value = 77;
  EXPECT_EQ(sphc_v4l2_get_control(camera.handle, V4L2_CID_ZOOM_ABSOLUTE, &value, &message), SPHC_E_UNSUPPORTED);
  EXPECT_EQ(value, 77);
  EXPECT_EQ(set(V4L2_CID_ZOOM_ABSOLUTE, 1), SPHC_E_UNSUPPORTED);
}

TEST_F(Controls, ExplainFailures) {
  kernel.failRequest(VIDIOC_S_EXT_CTRLS, EIO);
  EXPECT_EQ(set(kExposure, 90), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, HasSubstr("VIDIOC_S_EXT_CTRLS"));
  kernel.failRequest(VIDIOC_G_EXT_CTRLS, EIO);
  int64_t value = 0;
  EXPECT_EQ(sphc_v4l2_get_control(camera.handle, kExposure, &value, &message), SPHC_E_DEVICE);
  kernel.failRequest(VIDIOC_QUERY_EXT_CTRL, EIO);
  uint32_t count = 77;
  EXPECT_EQ(sphc_v4l2_list_controls(camera.handle, nullptr, 0, &count, &message), SPHC_E_DEVICE);
  EXPECT_EQ(count, 77u);
  kernel.unplug(0);
  EXPECT_EQ(set(kExposure, 90), SPHC_E_DEVICE_LOST);
  EXPECT_EQ(sphc_v4l2_set_control(nullptr, kExposure, 90, &message), SPHC_E_ARGUMENT);
}

TEST_F(Controls, OfExposureMoveTheTimeToItsMiddle) {
  ASSERT_EQ(camera.start(), SPHC_OK);
  const sphc_capture capture = camera.take();
  EXPECT_EQ(capture.exposure_us, 8000u);
  EXPECT_EQ(capture.time_point, SPHC_TIME_MIDDLE);
}

TEST_F(Controls, OfExposureAreNotBelievedWhileTheAutomaticCannotBeRead) {
  fake->findControl(kAuto)->value = V4L2_EXPOSURE_APERTURE_PRIORITY;
  kernel.failRequest(VIDIOC_G_EXT_CTRLS, EIO);  // of the automatic, which is read first
  ASSERT_EQ(camera.start(), SPHC_OK);
  EXPECT_EQ(camera.take().exposure_us, 0u);
}

TEST_F(Controls, OfExposureAreFollowedWhileRunning) {
  ASSERT_EQ(camera.start(), SPHC_OK);
  camera.release(camera.take());
  ASSERT_EQ(set(kExposure, 100), SPHC_OK);
  camera.release(camera.take());  // the news came while it waited
  EXPECT_EQ(camera.take().exposure_us, 10000u);
  EXPECT_GE(camera.stats().control_changes, 1u);
  ASSERT_EQ(set(kAuto, V4L2_EXPOSURE_APERTURE_PRIORITY), SPHC_OK);
  camera.release(camera.take());
  const sphc_capture automatic = camera.take();
  EXPECT_EQ(automatic.exposure_us, 0u) << "it may change from frame to frame";
  EXPECT_EQ(automatic.time_point, SPHC_TIME_START);
}

}  // namespace
}  // namespace sphc::v4l2
