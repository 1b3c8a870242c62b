// Every forbidden call of the localizer.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/capi/bytes.h"
#include "tests/support/map_bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;
using sphc::test::Session;

class CInterfaceFailure : public testing::Test {
 protected:
  void SetUp() override {
    frame_ = sphc::test::sceneFrame(config_, 0);
    ASSERT_EQ(sphc_localizer_memory(&config_, &need_, nullptr), SPHC_OK);
    state_ = GuardedMemory(need_.state_bytes + 64, 64);
    scratch_ = GuardedMemory(need_.scratch_bytes + 64, 64);
  }

  struct Init {
    void *state, *scratch;
    size_t state_bytes, scratch_bytes;
    const sphc_config *config;
    const sphc_map *const *maps;
    uint32_t map_count;
  };
  Init good() {
    return {state_.data(), scratch_.data(), need_.state_bytes, need_.scratch_bytes, &config_, &map_, 1};
  }
  void expectRefused(const Init &i, sphc_status expected, const char *words) {
    const std::vector<uint8_t> state = state_.copy(), scratch = scratch_.copy();
    sphc_localizer *made = nullptr;
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, i.maps, i.map_count,
                                  &made, &message),
              expected);
    expectMentions(message.text, words);
    EXPECT_EQ(made, nullptr);
    EXPECT_EQ(state_.copy(), state);
    EXPECT_EQ(scratch_.copy(), scratch);
  }

  void expectFrameRefused(const sphc_frame *frame, sphc_status expected, const char *words) {
    Output<sphc_result> result;
    result->struct_size = sizeof(sphc_result);
    const std::vector<uint8_t> before(reinterpret_cast<uint8_t *>(result.get()),
                                      reinterpret_cast<uint8_t *>(result.get() + 1));
    EXPECT_EQ(sphc_localizer_process(session_.localizer(), frame, result.get()), expected) << words;
    EXPECT_EQ(std::memcmp(result.get(), before.data(), before.size()), 0) << words;
    expectMentions(sphc_localizer_message(session_.localizer()), words);
  }
  void expectFrameRefused(void (*spoil)(sphc_frame *frame), sphc_status expected, const char *words) {
    sphc_frame frame = frame_->frame;
    spoil(&frame);
    expectFrameRefused(&frame, expected, words);
  }

  sphc_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
  std::unique_ptr<sphc::test::SceneFrame> frame_;
  const sphc_map *map_ = session_.map();
  sphc_memory need_ = {};
  GuardedMemory state_, scratch_;
};

TEST_F(CInterfaceFailure, InitNulls) {
  Init i = good();
  i.state = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "state memory is null");
  i = good(), i.scratch = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "scratch memory is null");
  i = good(), i.config = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "config is null");
  i = good(), i.maps = nullptr;
  expectRefused(i, SPHC_E_ARGUMENT, "list of maps is empty");
  i = good(), i.map_count = 0;
  expectRefused(i, SPHC_E_ARGUMENT, "list of maps is empty");
  const sphc_map *with_null[] = {map_, nullptr};
  i = good(), i.maps = with_null, i.map_count = 2;
  expectRefused(i, SPHC_E_ARGUMENT, "has a null in it");
  i = good(), i.map_count = SPHC_MAPS_MAX + 1;
  expectRefused(i, SPHC_E_CAPACITY, "17 maps were given; a localizer holds at most 16");
  i = good();
  sphc_message message = {};
  EXPECT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, i.maps, i.map_count,
                                nullptr, &message),
            SPHC_E_ARGUMENT);
  expectMentions(message.text, "localizer is null");
}

TEST_F(CInterfaceFailure, InitMemoryTooSmall) {
  Init i = good();
  --i.state_bytes;
  expectRefused(i, SPHC_E_MEMORY_SIZE, "state memory has");
  i = good(), i.state_bytes = 0;
  expectRefused(i, SPHC_E_MEMORY_SIZE, "has 0 bytes");
  i = good(), --i.scratch_bytes;
  expectRefused(i, SPHC_E_MEMORY_SIZE, "scratch memory has");
}

TEST_F(CInterfaceFailure, InitMemoryMisaligned) {
  for (size_t off : {1u, 8u, 32u}) {
    Init i = good();
    i.state = static_cast<uint8_t *>(i.state) + off;
    expectRefused(i, SPHC_E_MEMORY_ALIGNMENT, "state memory must be aligned to 64");
    i = good(), i.scratch = static_cast<uint8_t *>(i.scratch) + off;
    expectRefused(i, SPHC_E_MEMORY_ALIGNMENT, "scratch memory must be aligned to 64");
  }
}

TEST_F(CInterfaceFailure, InitMemoryOverlaps) {
  const size_t state_end = (need_.state_bytes + 63) / 64 * 64;
  GuardedMemory both(state_end + need_.scratch_bytes + 64, 64);
  auto *begin = static_cast<uint8_t *>(both.data());
  const std::vector<uint8_t> before = both.copy();
  Init i = good();
  i.state = begin;
  for (size_t off : {size_t{0}, size_t{64}, state_end - 64}) {
    i.scratch = begin + off;
    expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps scratch");
  }
  i = good(), i.scratch = begin;
  for (size_t off : {size_t{64}, (need_.scratch_bytes - 1) / 64 * 64}) {
    i.state = begin + off;
    expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps scratch");
  }
  EXPECT_EQ(both.copy(), before);
  i = good(), i.state = begin, i.scratch = begin + state_end;  // side by side
  sphc_localizer *made = nullptr;
  EXPECT_EQ(sphc_localizer_init(i.state, i.state_bytes, i.scratch, i.scratch_bytes, i.config, i.maps, i.map_count,
                                &made, nullptr),
            SPHC_OK);
}

TEST_F(CInterfaceFailure, InitMemoryOverlapsAMap) {
  // A file, its view and the list of maps, each inside memory that would be written.
  const std::vector<uint8_t> file = sphc::test::randomMap(50, 1);
  GuardedMemory memory(need_.scratch_bytes, 64), view_memory(4096, 64);
  std::memcpy(memory.data(), file.data(), file.size());
  sphc_map *view = nullptr;
  ASSERT_EQ(sphc_map_init(view_memory.data(), 4096, memory.data(), file.size(), &view, nullptr), SPHC_OK);
  const sphc_map *maps[] = {view};
  Init i = good();
  i.maps = maps;
  i.scratch = memory.data();
  expectRefused(i, SPHC_E_ARGUMENT, "scratch memory overlaps the file of a map");
  i = good(), i.state = memory.data(), i.maps = maps;
  expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps the file of a map");

  auto *inside = static_cast<uint8_t *>(memory.data()) + 1024;
  ASSERT_EQ(sphc_map_init(inside, 4096, file.data(), file.size(), &view, nullptr), SPHC_OK);
  maps[0] = view;
  expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps the view of a map");

  auto **list = reinterpret_cast<const sphc_map **>(inside);
  list[0] = map_;
  i.maps = list;
  expectRefused(i, SPHC_E_ARGUMENT, "state memory overlaps the list of maps");
}

TEST_F(CInterfaceFailure, InitBadConfig) {
  sphc_config bad = config_;
  bad.struct_size = 4;
  Init i = good();
  i.config = &bad;
  expectRefused(i, SPHC_E_STRUCT_SIZE, "struct_size is 4");
  bad = config_, bad.min_inliers = 0;
  expectRefused(i, SPHC_E_ARGUMENT, "min_inliers");
}

TEST_F(CInterfaceFailure, ProcessNulls) {
  sphc_result result = {};
  result.struct_size = sizeof result;
  EXPECT_EQ(sphc_localizer_process(nullptr, &frame_->frame, &result), SPHC_E_ARGUMENT);
  expectFrameRefused(static_cast<const sphc_frame *>(nullptr), SPHC_E_ARGUMENT, "frame is null");
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame_->frame, nullptr), SPHC_E_ARGUMENT);
  expectMentions(sphc_localizer_message(session_.localizer()), "result is null");
  EXPECT_STRNE(sphc_localizer_message(nullptr), "");
}

TEST_F(CInterfaceFailure, ProcessStructSizes) {
  expectFrameRefused([](sphc_frame *f) { f->struct_size = 0; }, SPHC_E_STRUCT_SIZE, "frame.struct_size is 0");
  expectFrameRefused([](sphc_frame *f) { f->struct_size += 1; }, SPHC_E_STRUCT_SIZE, "frame.struct_size");
  Output<sphc_result> result;  // struct_size is a pattern
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame_->frame, result.get()), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(result.untouched());
  expectMentions(sphc_localizer_message(session_.localizer()), "result.struct_size");
}

TEST_F(CInterfaceFailure, ProcessColorImage) {
  expectFrameRefused([](sphc_frame *f) { f->color.data = nullptr; }, SPHC_E_IMAGE,
                     "color image's data pointer is null");
  expectFrameRefused([](sphc_frame *f) { f->color.width = 319; }, SPHC_E_IMAGE, "319 x 240");
  expectFrameRefused([](sphc_frame *f) { f->color.height = 0; }, SPHC_E_IMAGE, "320 x 0");
  expectFrameRefused([](sphc_frame *f) { f->color.width = UINT32_MAX; }, SPHC_E_IMAGE, "4294967295");
  expectFrameRefused([](sphc_frame *f) { f->color.stride_bytes = 319; }, SPHC_E_IMAGE, "stride of 319");
  expectFrameRefused([](sphc_frame *f) { f->color.stride_bytes = 0; }, SPHC_E_IMAGE, "stride of 0");
  expectFrameRefused([](sphc_frame *f) { f->color.stride_bytes = UINT32_MAX; }, SPHC_E_IMAGE, "stride");
  expectFrameRefused([](sphc_frame *f) { f->color.format = SPHC_FORMAT_RGB8; }, SPHC_E_IMAGE, "stride of 320");
  expectFrameRefused([](sphc_frame *f) { f->color.format = SPHC_FORMAT_DEPTH16; }, SPHC_E_IMAGE, "format 10");
  expectFrameRefused([](sphc_frame *f) { f->color.format = 0; }, SPHC_E_IMAGE, "format 0");
  expectFrameRefused([](sphc_frame *f) { f->color.format = -1; }, SPHC_E_IMAGE, "format -1");
}

TEST_F(CInterfaceFailure, ProcessDepthImage) {
  expectFrameRefused([](sphc_frame *f) { f->depth.data = nullptr; }, SPHC_E_IMAGE,
                     "depth image's data pointer is null");
  expectFrameRefused([](sphc_frame *f) { f->depth.data = static_cast<const uint8_t *>(f->depth.data) + 1; },
                     SPHC_E_IMAGE, "odd");
  expectFrameRefused([](sphc_frame *f) { f->depth.stride_bytes = 401; }, SPHC_E_IMAGE, "must be even");
  expectFrameRefused([](sphc_frame *f) { f->depth.stride_bytes = 398; }, SPHC_E_IMAGE, "stride of 398");
  expectFrameRefused([](sphc_frame *f) { f->depth.width = 320; }, SPHC_E_IMAGE, "320 x 160");
  expectFrameRefused([](sphc_frame *f) { f->depth.format = SPHC_FORMAT_GRAY8; }, SPHC_E_IMAGE, "format 1");
}

TEST_F(CInterfaceFailure, TheNextFrameGoesOn) {
  expectFrameRefused([](sphc_frame *f) { f->color.data = nullptr; }, SPHC_E_IMAGE, "null");
  sphc_result result = {};
  EXPECT_EQ(session_.process(frame_->frame, &result), SPHC_OK);
  EXPECT_STREQ(sphc_localizer_message(session_.localizer()), "");
}

TEST_F(CInterfaceFailure, Observations) {
  Output<uint32_t> count;
  sphc_observation one;
  EXPECT_EQ(sphc_localizer_observations(nullptr, &one, 1, count.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), &one, 1, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_observations(session_.localizer(), nullptr, 1, count.get()), SPHC_E_ARGUMENT);
  EXPECT_TRUE(count.untouched());
}

}  // namespace
