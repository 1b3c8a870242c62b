/* A program of a header to come, in which every struct that grows has one field more (later.cmake): what it sets of
 * these is refused, and all else is served. */
#define SPHC_UNSTABLE 1
#include <spherecloud/spherecloud_capture.h>
#include <string.h>

#include "session.h"

/* Memory by the macros alone, as a program without a heap has it. */
enum { MAPS = 1 };
static _Alignas(64) uint8_t view[SPHC_MAP_BYTES_MAX], state[SPHC_LOCALIZER_STATE_BYTES_MAX(KEYPOINTS, MAPS)],
    scratch[SPHC_LOCALIZER_SCRATCH_BYTES_MAX(KEYPOINTS, 320, 240)];

/* Of a struct that only an _init function or a _get function fills. */
#define FILLED(type, call)                                                 \
  do {                                                                     \
    type filled;                                                           \
    memset(&filled, MARK, sizeof filled);                                  \
    filled.struct_size = sizeof filled;                                    \
    CHECK((call) == SPHC_OK);                                              \
    CHECK(filled.struct_size == sizeof filled && filled.added_later == 0); \
  } while (0)

static int everyOtherStruct(const sphc_map *map) {
  FILLED(sphc_map_info, sphc_map_get_info(map, &filled));
  FILLED(sphc_aligner_config, sphc_aligner_config_init(&filled, sizeof filled));
  FILLED(sphc_localizer_frame, sphc_localizer_frame_init(&filled, sizeof filled));
  FILLED(sphc_localizer_prior, sphc_localizer_prior_init(&filled, sizeof filled));
  FILLED(sphc_localizer_result, sphc_localizer_result_init(&filled, sizeof filled));
  FILLED(sphc_localizer_parameter_range, sphc_localizer_get_parameter_range(SPHC_PARAMETER_PROBES, &filled));
  FILLED(sphc_pairer_config, sphc_pairer_config_init(&filled, sizeof filled));
  FILLED(sphc_clock_mapper_config, sphc_clock_mapper_config_init(&filled, sizeof filled));
  return 0;
}

static int isRefused(sphc_status status, const char *message, const char *argument) {
  return status == SPHC_E_UNSUPPORTED && strstr(message, argument) && strstr(message, "is of a newer header");
}

static int aligned(const seen *what) {
  static uint16_t depth[320 * 240];
  sphc_aligner *aligner = NULL;
  sphc_aligner_config config;
  sphc_aligned to = {0};
  sphc_message message = {""};
  CHECK(sphc_aligner_config_init(&config, sizeof config) == SPHC_OK);
  config.rig = what->rig;
  config.added_later = 1;
  CHECK(isRefused(sphc_aligner_init(scratch, sizeof scratch, &config, &aligner, &message), message.text, "config"));
  config.added_later = 0;
  CHECK(sphc_aligner_init(scratch, sizeof scratch, &config, &aligner, &message) == SPHC_OK);
  to.struct_size = sizeof to;
  to.depth = depth;
  to.depth_stride_bytes = 2 * 320;
  to.added_later = 1;
  CHECK(isRefused(sphc_aligner_process(aligner, &what->depth, &to), sphc_aligner_message(aligner), "aligned"));
  to.added_later = 0;
  CHECK(sphc_aligner_process(aligner, &what->depth, &to) == SPHC_OK);
  sphc_aligner_fini(&aligner);
  return 0;
}

static int configured(const seen *what, sphc_localizer_config *config) {
  sphc_memory newer, known;
  sphc_message message = {""};
  memset(config, MARK, sizeof *config);
  CHECK(sphc_localizer_config_init(config, sizeof *config) == SPHC_OK && config->added_later == 0);
  config->rig = what->rig;
  config->max_keypoints = KEYPOINTS;
  config->max_maps = MAPS;
  CHECK(sphc_localizer_memory(config, &newer, &message) == SPHC_OK);
  config->struct_size = offsetof(sphc_localizer_config, added_later);
  CHECK(sphc_localizer_memory(config, &known, &message) == SPHC_OK && newer.state_bytes == known.state_bytes);
  config->struct_size = sizeof *config;
  config->added_later = 1;
  CHECK(isRefused(sphc_localizer_memory(config, &newer, &message), message.text, "config"));
  config->added_later = 0;
  return 0;
}

static int localized(sphc_localizer *localizer, const seen *what, sphc_rigid *camera_from_map) {
  sphc_localizer_prior prior = {0};
  sphc_localizer_frame frame = {0};
  sphc_localizer_result result;
  prior.struct_size = sizeof prior;
  frame.struct_size = sizeof frame;
  frame.color = what->color;
  frame.depth = what->depth;
  frame.prior = &prior;
  memset(&result, MARK, sizeof result);
  result.struct_size = sizeof result;

  prior.added_later = 1;
  CHECK(isRefused(sphc_localizer_process(localizer, &frame, &result), sphc_localizer_message(localizer), "prior"));
  prior.added_later = 0;
  frame.added_later = 1;
  CHECK(isRefused(sphc_localizer_process(localizer, &frame, &result), sphc_localizer_message(localizer), "frame"));
  frame.added_later = 0;
  CHECK(sphc_localizer_process(localizer, &frame, &result) == SPHC_OK);
  CHECK(result.struct_size == sizeof result && result.added_later == 0);
  *camera_from_map = result.camera_from_map;
  return 0;
}

/* The library knows by the stride which fields the caller has. */
static int observed(const sphc_localizer *localizer) {
  static sphc_localizer_observation observations[KEYPOINTS];
  uint32_t count = 0;
  memset(observations, MARK, sizeof observations);
  CHECK(sphc_localizer_observations(localizer, observations, sizeof *observations, KEYPOINTS, &count) == SPHC_OK);
  CHECK(count > 0 && observations[0].added_later == 0 && observations[count - 1].added_later == 0);
  return 0;
}

int session_of_another(const seen *what, sphc_rigid *camera_from_map) {
  sphc_map *map = NULL;
  sphc_localizer *localizer = NULL;
  sphc_localizer_config config;
  int line;
  CHECK(sphc_map_init(view, sizeof view, what->file, what->file_bytes, &map, NULL) == SPHC_OK);
  if ((line = everyOtherStruct(map)) || (line = aligned(what)) || (line = configured(what, &config))) return line;
  CHECK(sphc_localizer_init(state, sizeof state, scratch, sizeof scratch, &config, &localizer, NULL) == SPHC_OK);
  CHECK(sphc_localizer_set_map(localizer, 5, map) == SPHC_OK);
  if ((line = localized(localizer, what, camera_from_map)) || (line = observed(localizer))) return line;
  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  return 0;
}
