// From map_init to fini not one call reaches the heap.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <vector>

#include "tests/memory/sealed_heap.h"
#include "tests/support/session.h"

namespace sphc {
namespace {

TEST(SealedHeapDeathTest, ACallWhileSealedEndsTheProgram) {
  EXPECT_DEATH(
      {
        const test::SealedHeap sealed;
        volatile char *byte = static_cast<char *>(std::malloc(1));
        *byte = 0;
      },
      "sealed");
}

TEST(NoHeap, FromInitToFini) {
  const sphc_config config = test::sceneConfig();
  const test::SceneMap scene_map = test::makeSceneMap(config.color_camera, config.max_keypoints, 3, 0.5);
  std::vector<std::unique_ptr<test::SceneFrame>> frames;
  for (uint32_t viewpoint = 0; viewpoint < 4; ++viewpoint) frames.push_back(test::sceneFrame(config, viewpoint));
  frames[2]->frame.color.stride_bytes = 1;  // a refused frame must not allocate either
  size_t map_bytes = 0, map_alignment = 0;
  ASSERT_EQ(sphc_map_memory(&map_bytes, &map_alignment), SPHC_OK);
  sphc_memory need;
  sphc_message message = {};
  ASSERT_EQ(sphc_localizer_memory(&config, &need, &message), SPHC_OK);
  test::GuardedMemory map_memory(map_bytes, map_alignment);
  test::GuardedMemory state(need.state_bytes, need.alignment), scratch(need.scratch_bytes, need.alignment);
  ASSERT_GT(test::heapCalls(), 0u);

  sphc_status statuses[4] = {}, map_status = SPHC_E_INTERNAL, init_status = SPHC_E_INTERNAL;
  sphc_map *map = nullptr;
  sphc_localizer *localizer = nullptr;
  {
    const test::SealedHeap sealed;
    map_status =
        sphc_map_init(map_memory.data(), map_bytes, scene_map.file.data(), scene_map.file.size(), &map, &message);
    if (map_status == SPHC_OK)
      init_status = sphc_localizer_init(state.data(), state.size(), scratch.data(), scratch.size(), &config, map,
                                        &localizer, &message);
    for (uint32_t i = 0; init_status == SPHC_OK && i < 4; ++i) {
      sphc_result result = {};
      result.struct_size = sizeof result;
      statuses[i] = sphc_localizer_process(localizer, &frames[i]->frame, &result);
    }
    sphc_localizer_fini(&localizer);
    sphc_map_fini(&map);
  }
  EXPECT_EQ(map_status, SPHC_OK) << message.text;
  EXPECT_EQ(init_status, SPHC_OK) << message.text;
  EXPECT_EQ(statuses[0], SPHC_OK);
  EXPECT_EQ(statuses[1], SPHC_OK);
  EXPECT_EQ(statuses[2], SPHC_E_IMAGE);
  EXPECT_EQ(statuses[3], SPHC_OK);
  EXPECT_TRUE(state.guardsIntact());
  EXPECT_TRUE(scratch.guardsIntact());
}

}  // namespace
}  // namespace sphc
