// The plug pulled in every state, and put back.
#include <gmock/gmock.h>

#include "open_camera.h"

namespace sphc::contract {

namespace {

using Unplugging = VirtualCameras;

// Closed, opened again, it works.
void expectWorksWhenPluggedIn() {
  vtof::plug(0);
  const OpenCamera camera;
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.message();
  camera.passPair(1);
}

TEST_F(Unplugging, BeforeOpen) {
  vtof::unplug(0);
  EXPECT_EQ(OpenCamera().status(), SPHC_E_DEVICE);
  expectWorksWhenPluggedIn();
}

TEST_F(Unplugging, BeforeStart) {
  {
    const OpenCamera camera;
    vtof::unplug(0);
    EXPECT_EQ(camera.start(), SPHC_E_DEVICE_LOST);
    EXPECT_NE(camera.message(), "");
    EXPECT_EQ(camera.next(), SPHC_E_STATE);
  }
  expectWorksWhenPluggedIn();
}

TEST_F(Unplugging, WhileRunningGivesWhatHadComeFirst) {
  {
    const OpenCamera camera;
    ASSERT_EQ(camera.start(), SPHC_OK);
    camera.passPair(1);
    vtof::emitPair(0, 2);
    ASSERT_EQ(camera.next(), SPHC_OK);  // one of the two has come for sure
    vtof::unplug(0);
    sphc_status status = camera.next();
    if (status == SPHC_OK) status = camera.next();
    EXPECT_EQ(status, SPHC_E_DEVICE_LOST);
    EXPECT_THAT(camera.message(), ::testing::HasSubstr("unplugged"));
    EXPECT_EQ(camera.next(), SPHC_E_DEVICE_LOST) << "and stays so";
    camera.stop();
    EXPECT_EQ(camera.start(), SPHC_E_DEVICE_LOST);
  }
  expectWorksWhenPluggedIn();
}

TEST_F(Unplugging, WithLoansOut) {
  const OpenCamera camera;
  ASSERT_EQ(camera.start(), SPHC_OK);
  vtof::emitPair(0, 1);
  sphc_capture capture = {};
  ASSERT_EQ(camera.acquire(&capture), SPHC_OK);
  const uint8_t first = *static_cast<const uint8_t *>(capture.image.data);
  vtof::unplug(0);
  EXPECT_EQ(*static_cast<const uint8_t *>(capture.image.data), first) << "a loan outlives the device";
  camera.release(capture);
  camera.stop();
}

TEST_F(Unplugging, WhileFramesPour) {
  for (int i = 0; i < 10; ++i) {
    {
      const OpenCamera camera;
      ASSERT_EQ(camera.start(), SPHC_OK);
      vtof::run(0, true);
      for (int k = 0; k < i; ++k) ASSERT_EQ(camera.next(), SPHC_OK) << camera.message();
      vtof::unplug(0);
      sphc_status status = SPHC_OK;
      while (status == SPHC_OK) status = camera.next();
      EXPECT_EQ(status, SPHC_E_DEVICE_LOST);
    }
    vtof::plug(0);
  }
}

TEST_F(Unplugging, AfterStop) {
  {
    const OpenCamera camera;
    ASSERT_EQ(camera.start(), SPHC_OK);
    camera.stop();
    vtof::unplug(0);
    EXPECT_EQ(camera.start(), SPHC_E_DEVICE_LOST);
  }
  expectWorksWhenPluggedIn();
}

TEST_F(Unplugging, ANewDeviceWorksBesideTheOldHandle) {
  const OpenCamera old;
  ASSERT_EQ(old.start(), SPHC_OK);
  vtof::unplug(0);
  vtof::plug(0);
  EXPECT_EQ(old.next(), SPHC_E_DEVICE_LOST) << "it is another device now";
}

TEST_F(Unplugging, AnotherDeviceGoesOn) {
  const OpenCamera camera, other(cameraConfig(), vtof::uri(1));
  ASSERT_EQ(other.status(), SPHC_OK) << other.openMessage();
  ASSERT_EQ(other.start(), SPHC_OK);
  vtof::unplug(0);
  vtof::emitPair(1, 1);
  EXPECT_EQ(other.next(), SPHC_OK) << other.message();
}

}  // namespace

}  // namespace sphc::contract
