/* A whole session of a program that was built with an older header: this file is compiled against each of
 * headers/, with SESSION the name of its function.  What it is given are atoms, whose layout never changes. */
#include <spherecloud/spherecloud.h>
#include <stdlib.h>
#include <string.h>

#define MARK 0x5A
/* Something of the caller's lies behind every struct that the library writes to. */
#define MARKED(type)  \
  struct {            \
    type its;         \
    uint8_t mark[64]; \
  }
#define CHECK(right) \
  if (!(right)) return __LINE__

static int isMarked(const uint8_t *mark, size_t bytes) {
  size_t i;
  for (i = 0; i < bytes; ++i)
    if (mark[i] != MARK) return 0;
  return 1;
}

/* 0, or the line of what went wrong. */
int SESSION(const void *file, size_t file_bytes, const sphc_rig *rig, const sphc_image *color,
            const sphc_image *depth, sphc_rigid *camera_from_map);
int SESSION(const void *file, size_t file_bytes, const sphc_rig *rig, const sphc_image *color,
            const sphc_image *depth, sphc_rigid *camera_from_map) {
  MARKED(sphc_localizer_config) config;
  MARKED(sphc_map_info) info;
  MARKED(sphc_localizer_result) result;
  sphc_localizer_frame frame;
  sphc_localizer_prior prior;
  sphc_memory need;
  sphc_map *map = NULL;
  sphc_localizer *localizer = NULL;
  void *view, *state, *scratch;

  CHECK(sphc_map_memory(&need) == SPHC_OK);
  view = malloc(need.state_bytes);
  CHECK(sphc_map_init(view, need.state_bytes, file, file_bytes, &map, NULL) == SPHC_OK);
  memset(&info, MARK, sizeof info);
  info.its.struct_size = sizeof info.its;
  CHECK(sphc_map_get_info(map, &info.its) == SPHC_OK);
  CHECK(info.its.file_bytes == file_bytes && isMarked(info.mark, sizeof info.mark));

  memset(&config, MARK, sizeof config);
  CHECK(sphc_localizer_config_init(&config.its, sizeof config.its) == SPHC_OK);
  CHECK(isMarked(config.mark, sizeof config.mark));
  config.its.rig = *rig;
  CHECK(sphc_localizer_memory(&config.its, &need, NULL) == SPHC_OK);
  state = aligned_alloc(need.alignment, (need.state_bytes + need.alignment - 1) / need.alignment * need.alignment);
  scratch =
      aligned_alloc(need.alignment, (need.scratch_bytes + need.alignment - 1) / need.alignment * need.alignment);
  CHECK(sphc_localizer_init(state, need.state_bytes, scratch, need.scratch_bytes, &config.its, &localizer, NULL) ==
        SPHC_OK);
  CHECK(sphc_localizer_set_map(localizer, 5, map) == SPHC_OK);

  memset(&prior, 0, sizeof prior);
  prior.struct_size = sizeof prior;
  memset(&frame, 0, sizeof frame);
  frame.struct_size = sizeof frame;
  frame.color = *color;
  frame.depth = *depth;
  frame.prior = &prior;
  memset(&result, MARK, sizeof result);
  result.its.struct_size = sizeof result.its;
  CHECK(sphc_localizer_process(localizer, &frame, &result.its) == SPHC_OK);
  CHECK(result.its.struct_size == sizeof result.its && isMarked(result.mark, sizeof result.mark));
  CHECK(result.its.outcome == SPHC_OUTCOME_LOCALIZED);
  *camera_from_map = result.its.camera_from_map;

  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  free(scratch);
  free(state);
  free(view);
  return 0;
}
