// OpenNI2 is asked for frames by one thread of the process, and by none that ends.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "oni_file.h"
#include "open_camera.h"
#include "tests/contract/temp_folder.h"

namespace {

std::atomic<int> asking{0};  // the thread that asked
std::atomic<int> others{0};  // how often another one did

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
  return __real_oniWaitForAnyStream(streams, count, index, timeout_ms);
}

OniStatus __wrap_oniStreamReadFrame(OniStreamHandle stream, OniFrame **frame) {
  noteThread();
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
  const TempFolder folder;
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

}  // namespace

}  // namespace sphc::contract
