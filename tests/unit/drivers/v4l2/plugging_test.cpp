// The cable is pulled, or a call fails, at every single moment of a camera's life.
#include <gmock/gmock.h>

#include <cerrno>
#include <cstring>

#include "opened_camera.h"
#include "tests/support/jpeg_frame.h"

namespace sphc::v4l2 {
namespace {

using ::testing::HasSubstr;

struct CameraKind {
  const char *name;
  test::FakeCamera camera;
  sphc_v4l2_config config;
};

std::vector<CameraKind> kinds() {
  std::vector<CameraKind> all = {{"depth", depthCamera(), configFor(SPHC_STREAM_DEPTH)},
                                 {"dmabuf", depthCamera(), configFor(SPHC_STREAM_DEPTH)},
                                 {"colour", colorCamera(), configFor(SPHC_STREAM_COLOR)}};
  all[1].config.export_dmabuf = 1;
  return all;
}

// A life with everything in it, going on after each failure as a caller would.  Returns the calls made until the
// last acquire was back; who fails later is not asked any more.
uint32_t live(test::FakeKernel &kernel, const sphc_v4l2_config &config, std::vector<sphc_status> *failures) {
  const auto note = [&](sphc_status status, const char *text) {
    if (status >= 0) return;
    failures->push_back(status);
    EXPECT_TRUE(status == SPHC_E_DEVICE || status == SPHC_E_DEVICE_LOST || status == SPHC_E_UNSUPPORTED ||
                status == SPHC_E_STATE)
        << status;
    EXPECT_STRNE(text, "");
  };
  OpenedCamera camera(kernel, config);
  note(camera.status, camera.message.text);
  uint32_t calls = kernel.calls();
  if (!camera.handle) return calls;
  for (int run = 0; run < 2; ++run) {
    note(camera.start(), camera.text());
    sphc_capture kept = {};
    for (int i = 0; i < 6; ++i) {
      sphc_capture capture;
      const sphc_status status = camera.acquire(&capture, 50000);
      calls = kernel.calls();
      note(status, camera.text());
      if (status == SPHC_OK && kept.token == 0)
        kept = capture;
      else if (status == SPHC_OK)
        camera.release(capture);
    }
    if (kept.token != 0) {  // a loan outlives the camera: a sanitizer would see it if not
      uint8_t last;
      std::memcpy(
          &last,
          static_cast<const uint8_t *>(kept.image.data) + size_t{kept.image.stride_bytes} * (kept.image.height - 1),
          1);
      camera.release(kept);
    }
    camera.stop();
  }
  return calls;
}

struct Calls {
  uint32_t until_last_acquire, all;
};
Calls callsOfALife(const CameraKind &kind) {
  test::FakeKernel kernel;
  kernel.plugIn(0, kind.camera);
  std::vector<sphc_status> failures;
  const uint32_t until_last_acquire = live(kernel, kind.config, &failures);
  EXPECT_THAT(failures, ::testing::IsEmpty());
  return {until_last_acquire, kernel.calls()};
}

TEST(Plugging, UnpluggedAtAnyCallEndsWell) {
  for (const CameraKind &kind : kinds()) {
    const Calls calls = callsOfALife(kind);
    ASSERT_GT(calls.until_last_acquire, 50u);
    for (uint32_t call = 0; call < calls.all; ++call) {
      test::FakeKernel kernel;
      kernel.plugIn(0, kind.camera);
      kernel.unplugAtCall(call);
      std::vector<sphc_status> failures;
      live(kernel, kind.config, &failures);
      EXPECT_EQ(kernel.openFiles() + kernel.mappings(), 0u) << kind.name << " unplugged at call " << call;
      if (call + 1 < calls.until_last_acquire) {  // the very last call of it may be a dma-buf's, which has no say
        EXPECT_THAT(failures, ::testing::Not(::testing::IsEmpty())) << kind.name << " call " << call;
      }
      kernel.plugIn(0, kind.camera);  // and in again
      failures.clear();
      live(kernel, kind.config, &failures);
      EXPECT_THAT(failures, ::testing::IsEmpty()) << kind.name << " plugged in after call " << call;
    }
  }
}

TEST(Plugging, AnyErrorOfAnyCallEndsWell) {
  for (const CameraKind &kind : kinds()) {
    const uint32_t calls = callsOfALife(kind).all;
    for (const int error : {EAGAIN, EBUSY, EINTR, EINVAL, EIO, ENODEV, ENOMEM, ENOTTY})
      for (uint32_t call = 0; call < calls; ++call) {
        test::FakeKernel kernel;
        kernel.plugIn(0, kind.camera);
        kernel.failCall(call, error);
        std::vector<sphc_status> failures;
        live(kernel, kind.config, &failures);
        EXPECT_EQ(kernel.openFiles() + kernel.mappings(), 0u) << kind.name << " errno " << error << " at " << call;
      }
  }
}

TEST(Plugging, UnpluggedWhileRunningIsLostUntilItIsOpenedAgain) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  const sphc_capture kept = running.opened.take();
  running.kernel.unplug(0);
  sphc_capture capture;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(running.opened.acquire(&capture), SPHC_E_DEVICE_LOST);
    EXPECT_THAT(running.opened.text(), HasSubstr("unplugged; stop, close, and open it again"));
    EXPECT_THAT(running.opened.text(), HasSubstr("by bus= or card=: its node may have another number"));
  }
  running.opened.release(kept);
  running.opened.stop();
  EXPECT_EQ(running.opened.start(), SPHC_E_DEVICE_LOST);
  running.kernel.plugIn(0, depthCamera());
  EXPECT_EQ(running.opened.start(), SPHC_E_DEVICE_LOST) << "another node now";
  OpenedCamera again(running.kernel, configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(again.start(), SPHC_OK);
  again.take();
}

TEST(Plugging, UnpluggedWhileWaitingWakes) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  running.opened.take();
  running.camera->is_stalled = true;
  running.kernel.unplugAtCall(2);  // of acquire: events, DQBUF, poll
  sphc_capture capture;
  EXPECT_EQ(running.opened.acquire(&capture, UINT32_MAX), SPHC_E_DEVICE_LOST);
}

TEST(Plugging, AThousandTimesLeavesNothing) {
  test::FakeKernel kernel;
  const std::vector<CameraKind> all = kinds();
  for (uint32_t i = 0; i < 1000; ++i) {
    const CameraKind &kind = all[i % all.size()];
    const uint32_t number = i % 5;
    kernel.plugIn(number, kind.camera);
    OpenedCamera camera(kernel, kind.config, "card=Fake camera");
    ASSERT_EQ(camera.status, SPHC_OK) << camera.message.text;
    ASSERT_EQ(camera.start(), SPHC_OK);
    const sphc_capture kept = camera.take();
    if (i % 3) camera.release(kept);
    kernel.unplug(number);
    sphc_capture capture;
    ASSERT_EQ(camera.acquire(&capture), SPHC_E_DEVICE_LOST);
    if (i % 2) camera.stop();
  }
  EXPECT_EQ(kernel.openFiles(), 0u);
  EXPECT_EQ(kernel.mappings(), 0u);
}

}  // namespace
}  // namespace sphc::v4l2
