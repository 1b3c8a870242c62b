// OpenNI2 is asked for frames by one thread of the process, and by none that ends; a file for one at a time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "oni_file.h"
#include "open_camera.h"
#include "tests/support/temp_folder.h"

namespace {

std::atomic<int> asking{0};   // the thread that asked
std::atomic<int> others{0};   // how often another one did
std::atomic<int> in_vain{0};  // how often there was none since the last: OpenNI2 then asks the file
std::atomic<int> frames{0};

void noteThread() {
  int none = 0;
  const int self = gettid();
  if (!asking.compare_exchange_strong(none, self) && asking != self) ++others;
}

}  // namespace

// The linker calls these in place of OpenNI2's (--wrap).
extern "C" {

OniStatus __real_oniWaitForAnyStream(OniStreamHandle *streams, int count, int *index, int timeout_ms);
OniStatus __real_oniStreamReadFrame(OniStreamHandle stream, OniFrame **frame);

OniStatus __wrap_oniWaitForAnyStream(OniStreamHandle *streams, int count, int *index, int timeout_ms) {
  noteThread();
  const OniStatus status = __real_oniWaitForAnyStream(streams, count, index, timeout_ms);
  if (count > 0 && status != ONI_STATUS_OK) ++in_vain;
  return status;
}

OniStatus __wrap_oniStreamReadFrame(OniStreamHandle stream, OniFrame **frame) {
  noteThread();
  ++frames;
  in_vain = 0;
  return __real_oniStreamReadFrame(stream, frame);
}

}  // extern "C"

namespace sphc::contract {

namespace {

class OneReader : public VirtualCameras {};

TEST_F(OneReader, AsksForFramesOfCamerasThatThreadsOpenAndClose) {
  for (int i = 0; i < 4; ++i) {
    std::thread([] {
      const OpenCamera camera;
      ASSERT_EQ(camera.start(), SPHC_OK);
      vtof::emitPair(0, 7, 5000);
      EXPECT_EQ(camera.next(), SPHC_OK) << camera.message();
      EXPECT_EQ(camera.next(), SPHC_OK) << camera.message();
    }).join();
  }
  EXPECT_NE(asking, 0);
  EXPECT_NE(asking, gettid());
  EXPECT_EQ(others, 0);
}

TEST_F(OneReader, AsksForFramesOfRecordingsToo) {
  const test::TempFolder folder;
  const std::string path = folder / "made.oni";
  ASSERT_GT(writeOniFile(path, false), 0);
  others = 0;  // the recorder is the test's
  for (int i = 0; i < 3; ++i) {
    std::thread([&path] {
      const OpenCamera camera(cameraConfig(), path.c_str());
      ASSERT_EQ(camera.start(), SPHC_OK);
      EXPECT_EQ(camera.next(), SPHC_OK) << camera.message();
    }).join();
  }
  EXPECT_NE(asking, gettid());
  EXPECT_EQ(others, 0);
}

// A file that was asked twice gives two frames, of which the first is lost.
TEST_F(OneReader, AsksAFileForAFrameWhenItHasTheOneBefore) {
  const test::TempFolder folder;
  const std::string path = folder / "made.oni";
  ASSERT_GT(writeOniFile(path, false), 0);
  in_vain = frames = 0;
  {
    const OpenCamera camera(cameraConfig(), path.c_str());
    ASSERT_EQ(camera.start(), SPHC_OK) << camera.openMessage();
    for (sphc_status status = SPHC_OK; status == SPHC_OK || status == SPHC_AGAIN;) {
      status = camera.next(0);  // asks as often as it can
      EXPECT_LE(in_vain, 1) << "after frame " << frames;
    }
  }
  EXPECT_GE(frames, 2 * kPairsAtLeast);
}

}  // namespace

}  // namespace sphc::contract
