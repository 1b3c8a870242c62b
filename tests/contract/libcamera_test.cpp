// What the libcamera driver does with what a camera gives, through its interface, on a fake plug-in.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "drivers/libcamera/frame_time.h"
#include "drivers/libcamera/libcamera.h"
#include "fake_libcamera.h"

namespace sphc::contract {

namespace {

using libcamera::FrameClock;
using libcamera::FrameTime;
using libcamera::HostClocks;
using ::testing::HasSubstr;

constexpr int64_t kMs = 1000000, kS = 1000000000;

class Libcamera : public ::testing::Test {
 protected:
  Libcamera() {
    void *library = dlopen(SPHC_FAKE_LIBCAMERA, RTLD_NOW | RTLD_NODELETE);
    fake_ = reinterpret_cast<FakeLibcameraFn>(dlsym(library, kFakeLibcameraSymbol))();
    *fake_ = {};
    sphc_libcamera_config_init(&config_, sizeof config_);
    config_.plugin_path = SPHC_FAKE_LIBCAMERA;
    config_.width = 64;
    config_.height = 48;
  }
  ~Libcamera() override {
    sphc_libcamera_close(&camera_);
    EXPECT_EQ(fake_->open_devices, 0u);
    EXPECT_EQ(fake_->running_devices, 0u);
  }

  sphc_status open(const char *id = nullptr) {
    const sphc_status status = sphc_libcamera_open(id, &config_, &camera_, &message_);
    if (status == SPHC_OK) sphc_libcamera_source(camera_, &source_);
    return status;
  }
  void openAndStart() {
    ASSERT_EQ(open(), SPHC_OK) << message_.text;
    ASSERT_EQ(source_.start(source_.self), SPHC_OK) << text();
  }
  sphc_status acquire() {
    capture_ = {};
    capture_.struct_size = sizeof capture_;
    return source_.acquire(source_.self, 1000, &capture_);
  }
  // A capture that is released at once.
  sphc_status glance() {
    const sphc_status status = acquire();
    if (status == SPHC_OK) source_.release(source_.self, &capture_);
    return status;
  }
  const char *text() const { return source_.message(source_.self); }
  sphc_libcamera_info info() const {
    sphc_libcamera_info info;
    info.struct_size = sizeof info;
    EXPECT_EQ(sphc_libcamera_get_info(camera_, &info), SPHC_OK);
    return info;
  }
  void expectRefused(sphc_status status, const char *words) {
    EXPECT_EQ(open(), status);
    EXPECT_THAT(message_.text, HasSubstr(words));
    EXPECT_EQ(camera_, nullptr);
  }
  void offer(uint32_t index, const char *name, int64_t min, int64_t max) {
    fake_->controls[index] = {name, min, max, kNeverSet};
  }

  FakeLibcamera *fake_;
  sphc_libcamera_config config_;
  sphc_libcamera *camera_ = nullptr;
  sphc_source source_ = {};
  sphc_message message_ = {};
  sphc_capture capture_ = {};
};

// ---- plug-in and list ------------------------------------------------------------------------------------------

TEST_F(Libcamera, SaysHowToGetAPluginThatIsNotThere) {
  config_.plugin_path = "/nonexistent/plugin.so";
  expectRefused(SPHC_E_UNSUPPORTED, "libcamera-dev");
  EXPECT_THAT(message_.text, HasSubstr("/nonexistent/plugin.so"));
  EXPECT_THAT(message_.text, HasSubstr("install it"));
}

TEST_F(Libcamera, RefusesAPluginOfAnotherVersion) {
  fake_->speaks_our_version = false;
  expectRefused(SPHC_E_UNSUPPORTED, "another version");
}

TEST_F(Libcamera, RefusesALibraryThatIsNoPlugin) {
  config_.plugin_path = "libm.so.6";
  expectRefused(SPHC_E_UNSUPPORTED, "no plug-in of this driver");
}

TEST_F(Libcamera, ListsCamerasAndOpensOneById) {
  sphc_libcamera_name names[3] = {};
  uint32_t count = 0;
  ASSERT_EQ(sphc_libcamera_list(SPHC_FAKE_LIBCAMERA, names, 3, &count, &message_), SPHC_OK);
  ASSERT_EQ(count, 2u);
  EXPECT_STREQ(names[1].id, "fake-two");
  EXPECT_STREQ(names[1].model, "Fake 2");
  ASSERT_EQ(open("fake-two"), SPHC_OK);
  EXPECT_STREQ(info().name.id, "fake-two");
  EXPECT_STREQ(info().pixel_format, "YUYV");
  ASSERT_EQ(sphc_libcamera_list(SPHC_FAKE_LIBCAMERA, nullptr, 0, &count, &message_), SPHC_OK);
  EXPECT_EQ(count, 2u) << "and without room it counts";
}

TEST_F(Libcamera, SaysThatACameraIsNotThere) {
  EXPECT_EQ(open("fake-three"), SPHC_E_DEVICE);
  EXPECT_THAT(message_.text, HasSubstr("fake-three"));
}

#ifdef SPHC_REAL_LIBCAMERA
TEST(LibcameraPlugin, SpeaksToTheRealLibrary) {  // which sees cameras only where there are some: see tests/guest
  sphc_message message = {};
  uint32_t count = UINT32_MAX;
  ASSERT_EQ(sphc_libcamera_list(SPHC_REAL_LIBCAMERA, nullptr, 0, &count, &message), SPHC_OK) << message.text;
  EXPECT_NE(count, UINT32_MAX);
  sphc_libcamera_config config;
  sphc_libcamera_config_init(&config, sizeof config);
  config.plugin_path = SPHC_REAL_LIBCAMERA;
  sphc_libcamera *camera = nullptr;
  EXPECT_EQ(sphc_libcamera_open("no such camera", &config, &camera, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, HasSubstr("no such camera"));
}
#endif

// ---- negotiation -----------------------------------------------------------------------------------------------

TEST_F(Libcamera, NoticesAnotherSizeThanAskedFor) {
  fake_->other_width = 80;
  expectRefused(SPHC_E_UNSUPPORTED, "the camera would send 80 x 48");
}

TEST_F(Libcamera, TakesTheCamerasSizeWhenAskedForNone) {
  config_.width = config_.height = 0;
  fake_->other_width = 80;
  ASSERT_EQ(open(), SPHC_OK) << message_.text;
  EXPECT_EQ(info().width, 80u);
}

TEST_F(Libcamera, RefusesAPixelFormatThatTheCameraHasNot) {
  config_.pixel_format = "NV12";
  expectRefused(SPHC_E_UNSUPPORTED, "NV12");
}

TEST_F(Libcamera, RefusesTooFewBuffers) {
  fake_->buffers = 1;
  expectRefused(SPHC_E_DEVICE, "1 buffers");
}

TEST_F(Libcamera, ChecksItsConfig) {
  const sphc_libcamera_config good = config_;
  config_.loan_limit = 1;
  expectRefused(SPHC_E_ARGUMENT, "loan_limit 1");
  config_ = good;
  config_.format = SPHC_FORMAT_DEPTH16;
  expectRefused(SPHC_E_ARGUMENT, "BGR8");
  config_ = good;
  config_.width = 0;
  expectRefused(SPHC_E_ARGUMENT, "0 x 48");
  config_ = good;
  config_.pixel_format = "Z16";
  expectRefused(SPHC_E_ARGUMENT, "Z16");
  config_ = good;
  config_.struct_size = 3;
  expectRefused(SPHC_E_STRUCT_SIZE, "struct_size 3");
}

// ---- controls --------------------------------------------------------------------------------------------------

TEST_F(Libcamera, SetsTheExposureByModeWhereTheCameraHasOne) {
  offer(0, "ExposureTime", 100, 30000);
  offer(1, "ExposureTimeMode", 0, 1);
  offer(2, "AeEnable", 0, 1);
  config_.exposure_us = 5000;
  ASSERT_EQ(open(), SPHC_OK) << message_.text;
  EXPECT_EQ(fake_->controls[0].value, 5000);
  EXPECT_EQ(fake_->controls[1].value, 1) << "manual";
  EXPECT_EQ(fake_->controls[2].value, kNeverSet);
  EXPECT_EQ(info().exposure_max_us, 30000u);
}

TEST_F(Libcamera, SetsTheExposureByAeEnableOtherwise) {
  offer(0, "ExposureTime", 100, 30000);
  offer(1, "AeEnable", 0, 1);
  config_.exposure_us = 5000;
  ASSERT_EQ(open(), SPHC_OK) << message_.text;
  EXPECT_EQ(fake_->controls[1].value, 0);
  EXPECT_EQ(fake_->controls[0].value, 5000);
}

TEST_F(Libcamera, LeavesTheExposureToTheCamera) {
  offer(0, "ExposureTime", 100, 30000);
  offer(1, "AeEnable", 0, 1);
  ASSERT_EQ(open(), SPHC_OK) << message_.text;
  EXPECT_EQ(fake_->controls[1].value, 1);
  EXPECT_EQ(fake_->controls[0].value, kNeverSet);
}

TEST_F(Libcamera, RefusesAnExposureThatTheCameraCannotTake) {
  config_.exposure_us = 5000;
  expectRefused(SPHC_E_UNSUPPORTED, "cannot be set");
  offer(0, "ExposureTime", 100, 4000);
  expectRefused(SPHC_E_UNSUPPORTED, "100 to 4000");
}

// A control of a type that the plug-in does not know.
TEST_F(Libcamera, SaysWhichSettingTheCameraRefuses) {
  fake_->refuses_settings = true;
  offer(0, "ExposureTime", 100, 30000);
  offer(1, "FrameDurationLimits", 10000, 100000);
  config_.exposure_us = 5000;
  expectRefused(SPHC_E_UNSUPPORTED, "exposure_us 5000");
  config_.exposure_us = 0;
  config_.rate_hz = 25;
  expectRefused(SPHC_E_UNSUPPORTED, "rate_hz 25: this camera refuses it");
}

TEST_F(Libcamera, SetsTheRateOrRefusesIt) {
  config_.rate_hz = 25;
  expectRefused(SPHC_E_UNSUPPORTED, "rate_hz 25");
  offer(0, "FrameDurationLimits", 50000, 100000);
  expectRefused(SPHC_E_UNSUPPORTED, "50000 to 100000");
  offer(0, "FrameDurationLimits", 10000, 100000);
  ASSERT_EQ(open(), SPHC_OK) << message_.text;
  EXPECT_EQ(fake_->controls[0].value, 40000);
}

// A period of 60 Hz is no whole number of microseconds.
TEST_F(Libcamera, SetsTheFastestRate) {
  config_.rate_hz = 60;
  offer(0, "FrameDurationLimits", 16667, 100000);
  ASSERT_EQ(open(), SPHC_OK) << message_.text;
  EXPECT_EQ(fake_->controls[0].value, 16667);
}

// ---- frames ----------------------------------------------------------------------------------------------------

// The fake's byte i of frame 0.
uint8_t fakeByte(size_t i) { return static_cast<uint8_t>(16 + 3 * i % 200); }

TEST_F(Libcamera, GivesTheLumaOfYuyvByteForByte) {
  config_.format = SPHC_FORMAT_GRAY8;
  openAndStart();
  ASSERT_EQ(acquire(), SPHC_OK) << text();
  const auto *pixels = static_cast<const uint8_t *>(capture_.image.data);
  for (size_t y = 0; y < 48; ++y)
    for (size_t x = 0; x < 64; ++x)
      ASSERT_EQ(pixels[y * capture_.image.stride_bytes + x], fakeByte(y * (128 + 32) + 2 * x)) << x << " " << y;
}

TEST_F(Libcamera, JoinsTheTwoPlanesOfNv12) {
  std::strcpy(fake_->pixel_format, "NV12");
  openAndStart();
  EXPECT_EQ(acquire(), SPHC_OK) << text();
  EXPECT_EQ(capture_.image.format, SPHC_FORMAT_BGR8);
  // Pixel 0: the same Y, U, V as a grey pixel would have but for the chroma, which lies in the second plane.
  const auto *pixel = static_cast<const uint8_t *>(capture_.image.data);
  const int y = 76309 * (fakeByte(0) - 16) + 32768, u = fakeByte(96 * 48) - 128, v = fakeByte(96 * 48 + 1) - 128;
  EXPECT_EQ(pixel[0], std::clamp((y + 132201 * u) >> 16, 0, 255));
  EXPECT_EQ(pixel[2], std::clamp((y + 104597 * v) >> 16, 0, 255));
}

TEST_F(Libcamera, TakesTheGreyOfAnInfraredCamera) {
  std::strcpy(fake_->pixel_format, "R8");
  config_.format = SPHC_FORMAT_GRAY8;
  openAndStart();
  ASSERT_EQ(acquire(), SPHC_OK) << text();
  EXPECT_EQ(static_cast<const uint8_t *>(capture_.image.data)[5], fakeByte(5));
}

TEST_F(Libcamera, RefusesAFrameThatIsNoJpegAndGoesOn) {
  std::strcpy(fake_->pixel_format, "MJPG");
  openAndStart();
  EXPECT_EQ(acquire(), SPHC_E_DEVICE);
  EXPECT_STRNE(text(), "");
  EXPECT_EQ(acquire(), SPHC_E_DEVICE) << "and did not hang for want of buffers";
  for (int i = 0; i < 8; ++i) EXPECT_EQ(acquire(), SPHC_E_DEVICE);
  EXPECT_EQ(info().refused, 10u);
}

TEST_F(Libcamera, RefusesAShortFrameAndGoesOn) {
  openAndStart();
  fake_->missing_bytes = 40;
  EXPECT_EQ(glance(), SPHC_E_DEVICE);
  EXPECT_STRNE(text(), "");
  ASSERT_EQ(glance(), SPHC_OK) << text();
  EXPECT_EQ(capture_.sequence, 1u);
  EXPECT_EQ(info().refused, 1u);
}

TEST_F(Libcamera, RefusesADamagedFrameAndGoesOn) {
  openAndStart();
  ASSERT_EQ(glance(), SPHC_OK);
  fake_->next_damaged = true;
  EXPECT_EQ(glance(), SPHC_E_DEVICE);
  EXPECT_THAT(text(), HasSubstr("frame 1: damaged"));
  for (int i = 0; i < 10; ++i) ASSERT_EQ(glance(), SPHC_OK) << "its buffer went back: " << text();
}

TEST_F(Libcamera, CountsTheFramesThatAreMissing) {
  openAndStart();
  ASSERT_EQ(glance(), SPHC_OK);
  fake_->skip = 3;
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.sequence, 4u);
  EXPECT_EQ(info().lost, 3u);
}

TEST_F(Libcamera, NeverGivesANumberTwice) {
  openAndStart();
  for (int i = 0; i < 3; ++i) ASSERT_EQ(glance(), SPHC_OK);
  fake_->skip = UINT32_MAX - 1;  // back by two
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.sequence, 3u);
  EXPECT_EQ(info().lost, 0u);
}

TEST_F(Libcamera, KeepsTheCameraGoingWhileAllLoansAreOut) {
  openAndStart();
  sphc_capture loans[8];
  for (sphc_capture &loan : loans) {  // more than the camera has buffers
    ASSERT_EQ(acquire(), SPHC_OK) << text();
    loan = capture_;
  }
  EXPECT_EQ(acquire(), SPHC_E_STATE);
  source_.release(source_.self, &loans[3]);
  EXPECT_EQ(acquire(), SPHC_OK);
  EXPECT_EQ(info().lost, 0u);
}

TEST_F(Libcamera, SaysAgainWhileTheCameraStalls) {
  openAndStart();
  fake_->stalled = true;
  EXPECT_EQ(acquire(), SPHC_AGAIN);
  fake_->stalled = false;
  EXPECT_EQ(acquire(), SPHC_OK);
}

TEST_F(Libcamera, IsLostWhenUnpluggedAndComesBackWhenOpenedAgain) {
  openAndStart();
  ASSERT_EQ(acquire(), SPHC_OK);
  fake_->unplugged = true;
  EXPECT_EQ(acquire(), SPHC_E_DEVICE_LOST);
  EXPECT_STRNE(text(), "");
  source_.stop(source_.self);
  EXPECT_EQ(source_.start(source_.self), SPHC_E_DEVICE_LOST);
  sphc_libcamera_close(&camera_);
  fake_->unplugged = false;
  openAndStart();
  EXPECT_EQ(acquire(), SPHC_OK);
}

TEST_F(Libcamera, AThousandTimesUnpluggedLeavesNothing) {
  const auto files = [] {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return std::distance(begin(all), end(all));
  };
  const auto before = files();
  for (uint32_t i = 0; i < 1000; ++i) {
    openAndStart();
    ASSERT_EQ(i % 3 ? acquire() : glance(), SPHC_OK);
    fake_->unplugged = true;
    ASSERT_EQ(acquire(), SPHC_E_DEVICE_LOST);
    if (i % 2) source_.stop(source_.self);
    sphc_libcamera_close(&camera_);
    fake_->unplugged = false;
    ASSERT_EQ(fake_->open_devices, 0u);
  }
  EXPECT_EQ(files(), before);
}

TEST_F(Libcamera, StaysStoppedWhenTheCameraCannotStart) {
  ASSERT_EQ(open(), SPHC_OK);
  fake_->cannot_start = true;
  EXPECT_EQ(source_.start(source_.self), SPHC_E_DEVICE);
  EXPECT_THAT(text(), HasSubstr("bandwidth"));
  EXPECT_EQ(acquire(), SPHC_E_STATE);
  fake_->cannot_start = false;
  EXPECT_EQ(source_.start(source_.self), SPHC_OK);
}

// ---- time ------------------------------------------------------------------------------------------------------

TEST_F(Libcamera, GivesTheMiddleOfAnExposureThatTheCameraTells) {
  fake_->exposure_us = 8000;
  fake_->time_shift_ns = -20 * kMs;
  openAndStart();
  ASSERT_EQ(acquire(), SPHC_OK);
  EXPECT_EQ(capture_.time_point, SPHC_TIME_MIDDLE);
  EXPECT_EQ(capture_.clock, SPHC_CLOCK_MONOTONIC);
  EXPECT_EQ(capture_.exposure_us, 8000u);
  EXPECT_GT(capture_.time_sigma_us, 0u);
  EXPECT_LE(capture_.time_ns, capture_.arrival_ns - 16 * kMs);
}

TEST_F(Libcamera, GivesTheMiddleOfAnExposureThatWasSet) {
  offer(0, "ExposureTime", 100, 30000);
  config_.exposure_us = 5000;
  openAndStart();
  ASSERT_EQ(acquire(), SPHC_OK);
  EXPECT_EQ(capture_.time_point, SPHC_TIME_MIDDLE);
  EXPECT_EQ(capture_.exposure_us, 5000u);
}

TEST_F(Libcamera, DoesNotTellAnExposureThatTheCameraMayHaveRefused) {
  offer(0, "ExposureTime", 100, 30000);
  config_.exposure_us = 5000;
  openAndStart();
  fake_->refuses_next = true;
  EXPECT_EQ(glance(), SPHC_E_DEVICE);
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.exposure_us, 0u);
  EXPECT_EQ(capture_.time_point, SPHC_TIME_START);
  source_.stop(source_.self);
  ASSERT_EQ(source_.start(source_.self), SPHC_OK);  // which asks for it again
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.exposure_us, 5000u);
}

TEST_F(Libcamera, FallsBackToTheTimeOfArrivalAndSaysSo) {
  fake_->gives_time = false;
  openAndStart();
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.time_point, SPHC_TIME_ARRIVAL);
  EXPECT_EQ(capture_.time_ns, capture_.arrival_ns);
  fake_->gives_time = true;
  fake_->time_shift_ns = 3600 * kS;
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.time_point, SPHC_TIME_ARRIVAL) << "an hour ahead";
  fake_->time_shift_ns = -3600 * kS;
  ASSERT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(capture_.time_point, SPHC_TIME_ARRIVAL) << "an hour before the start";
  EXPECT_EQ(info().without_time, 3u);
}

TEST_F(Libcamera, RefusesATimeThatGoesBack) {
  openAndStart();
  ASSERT_EQ(glance(), SPHC_OK);
  fake_->time_shift_ns = -1500 * kMs;
  EXPECT_EQ(glance(), SPHC_E_DEVICE);
  EXPECT_THAT(text(), HasSubstr("before that of the last one"));
  fake_->time_shift_ns = 0;
  EXPECT_EQ(glance(), SPHC_OK);
  EXPECT_EQ(info().refused, 1u);
}

TEST(LibcameraFrameClock, TakesEitherOfTheHostsClocks) {
  const HostClocks never_slept = {100 * kS, 100 * kS};
  FrameClock clock;
  const FrameTime time = clock.frameTime(100 * kS - 30 * kMs, 0, never_slept);
  EXPECT_EQ(time.time_ns, 100 * kS - 30 * kMs);
  EXPECT_EQ(time.point, SPHC_TIME_START);

  const HostClocks slept_an_hour = {100 * kS, 3700 * kS};
  FrameClock by_book;
  EXPECT_EQ(by_book.frameTime(3700 * kS - 30 * kMs, 10000, slept_an_hour).time_ns, 100 * kS - 25 * kMs);
  FrameClock as_uvc;
  EXPECT_EQ(as_uvc.frameTime(100 * kS - 30 * kMs, 10000, slept_an_hour).time_ns, 100 * kS - 25 * kMs);
}

TEST(LibcameraFrameClock, AddsNoJitterOfReadingTwoClocks) {
  FrameClock clock;
  EXPECT_EQ(clock.frameTime(3700 * kS - 30 * kMs, 0, {100 * kS, 3700 * kS}).time_ns, 100 * kS - 30 * kMs);
  EXPECT_EQ(clock.frameTime(3700 * kS, 0, {100 * kS + 30 * kMs, 3700 * kS + 30 * kMs + 700}).time_ns, 100 * kS);
}

TEST(LibcameraFrameClock, FollowsASleepInTheMidstOfAStream) {
  FrameClock clock;
  EXPECT_EQ(clock.frameTime(3700 * kS, 0, {100 * kS, 3700 * kS}).time_ns, 100 * kS);
  EXPECT_EQ(clock.frameTime(7301 * kS, 0, {101 * kS, 7301 * kS}).time_ns, 101 * kS);
}

TEST(LibcameraFrameClock, TakesFramesThatWaitedLongForASlowCaller) {
  FrameClock clock;
  clock.restart({100 * kS, 3700 * kS});
  for (const int64_t slept_ns : {int64_t{0}, 3600 * kS}) {  // the clock of UVC cameras, and that of the book
    const FrameTime time = clock.frameTime(101 * kS + slept_ns, 0, {110 * kS, 3710 * kS});
    EXPECT_EQ(time.time_ns, 101 * kS);
    EXPECT_EQ(time.point, SPHC_TIME_START);
  }
}

// Once believed, it would have all frames of the next seconds refused as earlier ones.
TEST(LibcameraFrameClock, DoesNotBelieveAnExposureWhoseMiddleIsStillToCome) {
  FrameClock clock;
  const FrameTime time = clock.frameTime(100 * kS - 30 * kMs, 8000000, {100 * kS, 100 * kS});
  EXPECT_EQ(time.time_ns, 100 * kS - 30 * kMs);
  EXPECT_EQ(time.point, SPHC_TIME_START);
}

TEST(LibcameraFrameClock, SurvivesAnyNumber) {
  FrameClock clock;
  clock.restart({100 * kS, 100 * kS});
  for (const int64_t time_ns : {INT64_MIN, int64_t{-1}, int64_t{0}, int64_t{1}, INT64_MAX})
    for (const int64_t exposure_us : {INT64_MIN, int64_t{-1}, int64_t{1}, INT64_MAX})
      EXPECT_EQ(clock.frameTime(time_ns, exposure_us, {100 * kS, 100 * kS}).point, SPHC_TIME_ARRIVAL);
  EXPECT_EQ(clock.frameTime(100 * kS, INT64_MAX, {100 * kS, 100 * kS}).point, SPHC_TIME_START);
}

}  // namespace

}  // namespace sphc::contract
