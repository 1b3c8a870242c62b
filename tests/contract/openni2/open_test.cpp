// What is asked of a device when it is opened, and what it says of itself.
#include <gmock/gmock.h>

#include <cmath>

#include "open_camera.h"

namespace sphc::contract {

namespace {

using ::testing::HasSubstr;
using Opening = VirtualCameras;

sphc_openni2_config with(sphc_openni2_mode color, sphc_openni2_mode depth) {
  sphc_openni2_config config = cameraConfig();
  config.color = color;
  config.depth = depth;
  return config;
}

void expectRefused(const sphc_openni2_config &config, sphc_status status, const std::string &text) {
  const OpenCamera camera(config);
  EXPECT_EQ(camera.status(), status);
  EXPECT_EQ(camera.get(), nullptr);
  EXPECT_THAT(camera.openMessage(), HasSubstr(text));
}

TEST_F(Opening, ListsTheDevices) {
  sphc_openni2_device devices[3] = {};
  uint32_t count = 0;
  ASSERT_EQ(sphc_openni2_list(devices, 3, &count, nullptr), SPHC_OK);
  ASSERT_EQ(count, 2u);
  EXPECT_STREQ(devices[0].uri, vtof::uri(0));
  EXPECT_STREQ(devices[0].vendor, "SphereCloud");
  EXPECT_STREQ(devices[1].name, "virtual ToF camera 1");
  vtof::unplug(0);
  ASSERT_EQ(sphc_openni2_list(devices, 1, &count, nullptr), SPHC_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_STREQ(devices[0].uri, vtof::uri(1));
  EXPECT_EQ(sphc_openni2_list(nullptr, 1, &count, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_openni2_list(nullptr, 0, &count, nullptr), SPHC_OK);
  EXPECT_EQ(count, 1u);
}

TEST_F(Opening, TakesTheFirstDeviceWhenNoneIsNamed) {
  const OpenCamera camera(cameraConfig(), nullptr);
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  EXPECT_STREQ(camera.info().device.uri, vtof::uri(0));
}

TEST_F(Opening, SaysWhatToDoWhenNoDeviceIsThere) {
  vtof::unplug(0);
  vtof::unplug(1);
  const OpenCamera camera(cameraConfig(), nullptr);
  EXPECT_EQ(camera.status(), SPHC_E_DEVICE);
  EXPECT_THAT(camera.openMessage(), HasSubstr("udev"));
}

TEST_F(Opening, SaysWhyADeviceCannotBeOpened) {
  const OpenCamera camera(cameraConfig(), "vtof://7");
  EXPECT_EQ(camera.status(), SPHC_E_DEVICE);
  EXPECT_THAT(camera.openMessage(), HasSubstr("vtof://7 cannot be opened"));
  vtof::Faults faults = {};
  faults.does_not_open = true;
  vtof::setFaults(0, faults);
  expectRefused(cameraConfig(), SPHC_E_DEVICE, "end the program that has it");
  const OpenCamera endless(cameraConfig(), std::string(300, 'x').c_str());
  EXPECT_EQ(endless.status(), SPHC_E_ARGUMENT);
}

TEST_F(Opening, OpensADeviceOnceInAProcess) {
  const OpenCamera first;
  ASSERT_EQ(first.status(), SPHC_OK);
  expectRefused(cameraConfig(), SPHC_E_DEVICE, "open in this process already");
  ASSERT_EQ(first.start(), SPHC_OK);
  first.passPair(1);  // the first one goes on
}

TEST_F(Opening, KeepsThePresentModeWhenNoneIsAsked) {
  const OpenCamera camera;
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  const sphc_openni2_info info = camera.info();
  EXPECT_EQ(info.color.width, 320u);
  EXPECT_EQ(info.color.frames_per_s, 30u);
  EXPECT_EQ(info.color_format, SPHC_FORMAT_RGB8);
  EXPECT_EQ(info.depth.height, 240u);
  EXPECT_EQ(info.depth_unit_m, 0.001);
  EXPECT_EQ(info.is_recording, 0u);
}

TEST_F(Opening, PassesOverFormatsThatItCannotPassOn) {
  const OpenCamera camera(with({640, 480, 30}, {640, 480, 0}));  // offered as YUV422 and SHIFT_9_2 first
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  EXPECT_EQ(camera.info().color_format, SPHC_FORMAT_RGB8);
  EXPECT_EQ(camera.info().depth.width, 640u);
}

TEST_F(Opening, TakesGrayAndTenthsOfMillimetres) {
  const OpenCamera camera(with({160, 0, 0}, {0, 0, 15}));
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  EXPECT_EQ(camera.info().color_format, SPHC_FORMAT_GRAY8);
  EXPECT_EQ(camera.info().depth_unit_m, 0.0001);
}

TEST_F(Opening, NamesTheModesWhenNoneFits) {
  expectRefused(with({123, 45, 0}, {}), SPHC_E_UNSUPPORTED, "640x480@30 YUV422, 640x480@30 RGB888");
  expectRefused(with({}, {0, 0, 99}), SPHC_E_UNSUPPORTED, "no depth mode of 0x0@99");
}

TEST_F(Opening, NoticesAModeThatWasChangedInSilence) {
  vtof::Faults faults = {};
  faults.grants_another_mode = true;
  vtof::setFaults(0, faults);
  expectRefused(with({640, 480, 30}, {}), SPHC_E_UNSUPPORTED, "the device runs 320x240@30 RGB888");
  faults = {};
  faults.refuses_modes = true;
  vtof::setFaults(0, faults);
  expectRefused(with({640, 480, 30}, {}), SPHC_E_UNSUPPORTED, "640x480@30 RGB888 was offered");
}

TEST_F(Opening, SwitchesRegistrationAndReadsItBack) {
  sphc_openni2_config config = cameraConfig();
  config.registration = 1;
  {
    const OpenCamera camera(config);
    ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
    EXPECT_EQ(camera.info().registration, 1u);
    EXPECT_TRUE(vtof::registered(0));
  }
  const OpenCamera camera;
  EXPECT_EQ(camera.info().registration, 0u);
  EXPECT_FALSE(vtof::registered(0)) << "left on by the one before";
}

TEST_F(Opening, RefusesRegistrationThatIsNotThere) {
  sphc_openni2_config config = cameraConfig();
  config.registration = 1;
  vtof::Faults faults = {};
  faults.ignores_registration = true;
  vtof::setFaults(0, faults);
  expectRefused(config, SPHC_E_UNSUPPORTED, "says it did, but did not");
  faults = {};
  faults.cannot_register = true;
  vtof::setFaults(0, faults);
  expectRefused(config, SPHC_E_UNSUPPORTED, "the device cannot");
  EXPECT_EQ(OpenCamera().status(), SPHC_OK);
}

TEST_F(Opening, RefusesImagesThatStayMirrored) {
  vtof::Faults faults = {};
  faults.stays_mirrored = true;
  vtof::setFaults(0, faults);
  expectRefused(cameraConfig(), SPHC_E_UNSUPPORTED, "mirrored");
}

TEST_F(Opening, ChecksTheConfig) {
  const auto refused = [](void (*spoil)(sphc_openni2_config *), const char *field) {
    sphc_openni2_config config = cameraConfig();
    spoil(&config);
    expectRefused(config, SPHC_E_ARGUMENT, field);
  };
  refused([](sphc_openni2_config *c) { c->streams = 0; }, "streams");
  refused([](sphc_openni2_config *c) { c->streams = 4; }, "streams");
  refused([](sphc_openni2_config *c) { c->registration = 2; }, "registration");
  refused([](sphc_openni2_config *c) { c->frame_sync = 2; }, "frame_sync");
  refused([](sphc_openni2_config *c) { c->loan_limit = 1; }, "loan_limit");
  refused([](sphc_openni2_config *c) { c->loan_limit = 65; }, "loan_limit");
  refused([](sphc_openni2_config *c) { c->stall_us = 999; }, "stall_us");
  refused([](sphc_openni2_config *c) { c->order_wait_us = 1000001; }, "order_wait_us");
  refused([](sphc_openni2_config *c) { c->time_point = 4; }, "time_point");
  refused([](sphc_openni2_config *c) { c->reserved = 1; }, "reserved");
  sphc_openni2_config config = cameraConfig();
  config.struct_size = 4;
  expectRefused(config, SPHC_E_STRUCT_SIZE, "sphc_openni2_config_init");
  EXPECT_EQ(sphc_openni2_config_init(nullptr, sizeof config), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_openni2_config_init(&config, 4), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_openni2_open(nullptr, nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
}

TEST_F(Opening, HintsAtTheCalibration) {
  const OpenCamera camera(with({}, {320, 288, 30}));
  const sphc_openni2_info info = camera.info();
  EXPECT_EQ(info.color_camera.model, SPHC_CAMERA_PINHOLE);
  EXPECT_EQ(info.depth_camera.height, 288u);
  EXPECT_EQ(info.depth_camera.param_count, 4u);
  EXPECT_NEAR(2 * std::atan(144 / info.depth_camera.params[1]), 0.8, 1e-6);
  EXPECT_NEAR(2 * std::atan(160 / info.color_camera.params[0]), 1.0, 1e-6);
  EXPECT_EQ(info.color_camera.params[3], 120);
  EXPECT_NEAR(info.baseline_m, 0.025, 1e-12);
}

TEST_F(Opening, SetsControlsAndReadsThemBack) {
  const OpenCamera camera;
  sphc_message message = {};
  int32_t value = -1;
  ASSERT_EQ(sphc_openni2_get_control(camera.get(), SPHC_OPENNI2_AUTO_EXPOSURE, &value, &message), SPHC_OK);
  EXPECT_EQ(value, 1);
  ASSERT_EQ(sphc_openni2_set_control(camera.get(), SPHC_OPENNI2_AUTO_EXPOSURE, 0, &message), SPHC_OK);
  ASSERT_EQ(sphc_openni2_set_control(camera.get(), SPHC_OPENNI2_EXPOSURE, 33, &message), SPHC_OK);
  ASSERT_EQ(sphc_openni2_get_control(camera.get(), SPHC_OPENNI2_EXPOSURE, &value, &message), SPHC_OK);
  EXPECT_EQ(value, 33);
  EXPECT_EQ(sphc_openni2_set_control(camera.get(), SPHC_OPENNI2_GAIN, 5, &message), SPHC_E_UNSUPPORTED);
  EXPECT_THAT(message.text, HasSubstr("gain"));
  EXPECT_EQ(sphc_openni2_get_control(camera.get(), 9, &value, &message), SPHC_E_ARGUMENT);
  vtof::Faults faults = {};
  faults.keeps_exposure = true;
  vtof::setFaults(0, faults);
  EXPECT_EQ(sphc_openni2_set_control(camera.get(), SPHC_OPENNI2_EXPOSURE, 44, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, HasSubstr("cannot be set to 44: it is 33"));
}

TEST_F(Opening, TakesOneStreamAlone) {
  sphc_openni2_config config = cameraConfig();
  config.streams = SPHC_OPENNI2_STREAM_DEPTH;
  const OpenCamera camera(config);
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  EXPECT_EQ(camera.info().color.width, 0u);
  EXPECT_EQ(camera.info().color_camera.param_count, 0u);
  int32_t value = 0;
  EXPECT_EQ(sphc_openni2_get_control(camera.get(), SPHC_OPENNI2_EXPOSURE, &value, nullptr), SPHC_E_UNSUPPORTED);
  ASSERT_EQ(camera.start(), SPHC_OK);
  ASSERT_TRUE(vtof::emit(0, plainFrame(ONI_SENSOR_DEPTH, 1, 1000)));
  EXPECT_EQ(camera.next(), SPHC_OK) << camera.message();
}

TEST_F(Opening, RefusesNullsAndForeignSizes) {
  const OpenCamera camera;
  sphc_openni2_info info = {};
  sphc_openni2_statistics statistics = {};
  sphc_source source = {};
  EXPECT_EQ(sphc_openni2_get_info(camera.get(), &info), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_openni2_get_info(nullptr, &info), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_openni2_get_statistics(camera.get(), &statistics), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_openni2_get_statistics(camera.get(), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_openni2_source(nullptr, &source), SPHC_E_ARGUMENT);
  sphc_openni2 *none = nullptr;
  sphc_openni2_close(&none);
  sphc_openni2_close(nullptr);
}

}  // namespace

}  // namespace sphc::contract
