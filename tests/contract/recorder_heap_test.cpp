// The recorder takes its memory at open: between the first captures and the end nothing calls operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

#include "tests/support/temp_folder.h"
#include "tiny_mcap.h"

namespace {
std::atomic<uint64_t> allocations{0};
}

void *operator new(size_t bytes) {
  ++allocations;
  if (void *memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
// Inlined beside a new that is not, gcc takes the two for a pair that does not match.
__attribute__((noinline)) void operator delete(void *memory) noexcept { std::free(memory); }
__attribute__((noinline)) void operator delete(void *memory, size_t) noexcept { std::free(memory); }

namespace sphc::contract {

namespace {

// Until so many images of each stream are in the file.
void waitUntilWritten(const sphc_recorder *recorder, uint64_t count) {
  sphc_recorder_statistics statistics{};
  statistics.struct_size = sizeof statistics;
  while (statistics.depth_count < count || statistics.color_count < count) {
    ASSERT_EQ(sphc_recorder_get_statistics(recorder, &statistics), SPHC_OK);
    std::this_thread::yield();
  }
}

TEST(RecorderHeap, TakesNothingAfterTheFirstCaptures) {
  for (const sphc_depth_codec codec : {SPHC_DEPTH_RAW, SPHC_DEPTH_RVL, SPHC_DEPTH_ZSTD}) {
    const test::TempFolder folder;
    sphc_recorder_config config = recorderConfig();
    config.depth_codec = codec;
    config.sync_ms = 10;
    config.chunk_bytes = 65536;
    OpenRecorder recorder(folder / "walk.mcap", config);
    const TinyImages images(1);
    const std::vector<uint16_t> amplitude = tinyAmplitude(1);
    int64_t felt_ns = 0;
    const auto add = [&](uint32_t first, uint32_t end) {
      for (uint32_t i = first; i < end; ++i)
        for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
          const double felt_mps2[3] = {0, 0, 9.8};
          for (int k = 0; k < 300; ++k)  // more than wait for a capture
            ASSERT_EQ(sphc_recorder_add_acceleration(recorder.get(), ++felt_ns, felt_mps2, nullptr), SPHC_OK);
          sphc_capture capture = tinyCapture(i, stream, images);
          if (stream == SPHC_STREAM_DEPTH) capture.amplitude = amplitudeImage(amplitude);
          ASSERT_EQ(sphc_recorder_add(recorder.get(), &capture, nullptr), SPHC_OK);
        }
    };
    add(0, 3);
    waitUntilWritten(recorder.get(), 3);
    const uint64_t before = allocations;
    ASSERT_GT(before, 0u) << "they are counted";
    add(3, 100);
    waitUntilWritten(recorder.get(), 100);
    EXPECT_EQ(allocations, before) << "codec " << codec;
    EXPECT_EQ(recorder.close(), SPHC_OK);
  }
}

}  // namespace

}  // namespace sphc::contract
