/* A whole session of a program: this file is compiled against today's header and each one that was kept, with
 * SESSION the name of its function. */
#include "session.h"

#include <stdlib.h>
#include <string.h>

#include "../../portability/aligned_block.h"

/* Something of the caller's lies behind every struct that the library writes to. */
#define MARKED(type)  \
  struct {            \
    type its;         \
    uint8_t mark[64]; \
  }

static int isMarked(const uint8_t *mark, size_t bytes) {
  size_t i;
  for (i = 0; i < bytes; ++i)
    if (mark[i] != MARK) return 0;
  return 1;
}

/* 0, or the line of what went wrong; so do all below. */
static int aligns(const seen *what) {
  MARKED(sphc_aligner_config) config;
  sphc_aligned aligned;
  sphc_memory need;
  sphc_aligner *aligner = NULL;
  size_t bytes;
  void *memory, *block;
  uint16_t *depth = (uint16_t *)calloc((size_t)what->color.width * what->color.height, sizeof *depth);
  memset(&config, MARK, sizeof config);
  CHECK(sphc_aligner_config_init(&config.its, sizeof config.its) == SPHC_OK);
  CHECK(isMarked(config.mark, sizeof config.mark));
  config.its.rig = what->rig;
  CHECK(sphc_aligner_memory(&config.its, &need, NULL) == SPHC_OK);
  bytes = (size_t)need.state_bytes;
  memory = aligned_block(bytes, need.alignment, &block);
  CHECK(sphc_aligner_init(memory, bytes, &config.its, &aligner, NULL) == SPHC_OK);
  memset(&aligned, 0, sizeof aligned);
  aligned.struct_size = sizeof aligned;
  aligned.depth = depth;
  aligned.depth_stride_bytes = what->color.width * (uint32_t)sizeof *depth;
  CHECK(sphc_aligner_process(aligner, &what->depth, &aligned) == SPHC_OK);
  CHECK(depth[what->color.width * (what->color.height / 2) + what->color.width / 2] > 0);
  sphc_aligner_fini(&aligner);
  free(block);
  free(depth);
  return 0;
}

static int inspects(const sphc_localizer *localizer) {
  MARKED(sphc_localizer_parameter_range) range;
  static sphc_localizer_observation observations[KEYPOINTS];
  uint32_t count = 0, matched = 0, i;
  memset(&range, MARK, sizeof range);
  range.its.struct_size = sizeof range.its;
  CHECK(sphc_localizer_get_parameter_range(SPHC_PARAMETER_PROBES, &range.its) == SPHC_OK);
  CHECK(range.its.struct_size == sizeof range.its && isMarked(range.mark, sizeof range.mark));
  CHECK(sphc_localizer_observations(localizer, observations, sizeof *observations, KEYPOINTS - 1, &count) ==
        SPHC_OK);
  for (i = 0; i < count && i < KEYPOINTS - 1; ++i)
    matched += (observations[i].flags & SPHC_OBSERVATION_MATCHED) != 0;
  CHECK(matched > 0 && observations[KEYPOINTS - 1].flags == 0);
  return 0;
}

int SESSION(const seen *what, sphc_rigid *camera_from_map) {
  MARKED(sphc_localizer_config) config;
  MARKED(sphc_map_info) info;
  MARKED(sphc_localizer_result) result;
  sphc_localizer_frame frame;
  sphc_localizer_prior prior;
  sphc_memory need;
  sphc_map *map = NULL;
  sphc_localizer *localizer = NULL;
  void *view, *state, *scratch, *view_block, *state_block, *scratch_block;
  size_t view_bytes, state_bytes, scratch_bytes;
  int line;

  CHECK(sphc_map_memory(&need) == SPHC_OK && need.state_bytes <= SPHC_MAP_BYTES_MAX);
  view_bytes = (size_t)need.state_bytes;
  view = aligned_block(view_bytes, need.alignment, &view_block);
  CHECK(sphc_map_init(view, view_bytes, what->file, what->file_bytes, &map, NULL) == SPHC_OK);
  memset(&info, MARK, sizeof info);
  info.its.struct_size = sizeof info.its;
  CHECK(sphc_map_get_info(map, &info.its) == SPHC_OK);
  CHECK(info.its.file_bytes == what->file_bytes && isMarked(info.mark, sizeof info.mark));

  memset(&config, MARK, sizeof config);
  CHECK(sphc_localizer_config_init(&config.its, sizeof config.its) == SPHC_OK);
  CHECK(isMarked(config.mark, sizeof config.mark));
  config.its.rig = what->rig;
  config.its.max_keypoints = KEYPOINTS;
  CHECK(sphc_localizer_memory(&config.its, &need, NULL) == SPHC_OK);
  CHECK(need.state_bytes <= SPHC_LOCALIZER_STATE_BYTES_MAX(config.its.max_keypoints, config.its.max_maps));
  CHECK(need.scratch_bytes <=
        SPHC_LOCALIZER_SCRATCH_BYTES_MAX(config.its.max_keypoints, what->color.width, what->color.height));
  state_bytes = (size_t)need.state_bytes;
  scratch_bytes = (size_t)need.scratch_bytes;
  state = aligned_block(state_bytes, need.alignment, &state_block);
  scratch = aligned_block(scratch_bytes, need.alignment, &scratch_block);
  CHECK(sphc_localizer_init(state, state_bytes, scratch, scratch_bytes, &config.its, &localizer, NULL) == SPHC_OK);
  CHECK(sphc_localizer_set_map(localizer, 5, map) == SPHC_OK);

  memset(&prior, 0, sizeof prior);
  prior.struct_size = sizeof prior;
  memset(&frame, 0, sizeof frame);
  frame.struct_size = sizeof frame;
  frame.color = what->color;
  frame.depth = what->depth;
  frame.prior = &prior;
  memset(&result, MARK, sizeof result);
  result.its.struct_size = sizeof result.its;
  CHECK(sphc_localizer_process(localizer, &frame, &result.its) == SPHC_OK);
  CHECK(result.its.struct_size == sizeof result.its && isMarked(result.mark, sizeof result.mark));
  CHECK(result.its.outcome == SPHC_OUTCOME_LOCALIZED);
  *camera_from_map = result.its.camera_from_map;
  if ((line = aligns(what)) || (line = inspects(localizer))) return line;

  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  free(scratch_block);
  free(state_block);
  free(view_block);
  return 0;
}
