/* firmware_c - a pose a frame on a board without an operating system: the map in read-only memory, the library's
 * memory in static buffers, no heap, no files, no threads.  C99; nothing of the C library is called.
 *
 * board.h says what your board brings. */
#include "board.h"

enum { KEYPOINTS = 400, MAPS = 1 };
static __attribute__((aligned(64))) uint8_t view[SPHC_MAP_BYTES_MAX],
    state[SPHC_LOCALIZER_STATE_BYTES_MAX(KEYPOINTS, MAPS)],
    scratch[SPHC_LOCALIZER_SCRATCH_BYTES_MAX(KEYPOINTS, BOARD_COLOR_WIDTH, BOARD_COLOR_HEIGHT)];

static int failed(sphc_status status, const char *text) {
  if (status < 0) board_send_failure(sphc_status_name(status), text);
  return status < 0;
}

static sphc_localizer *make_localizer(const sphc_map *map) {
  static sphc_message message;
  static sphc_localizer_config config;
  sphc_localizer *localizer = NULL;
  if (failed(sphc_localizer_config_init(&config, sizeof config), "config")) return NULL;
  board_rig(&config.rig);
  config.clock = board_time_ns;
  config.max_keypoints = KEYPOINTS;
  config.max_maps = MAPS;
  if (failed(sphc_localizer_init(state, sizeof state, scratch, sizeof scratch, &config, &localizer, &message),
             message.text) ||
      failed(sphc_localizer_set_map(localizer, 0, map), sphc_localizer_message(localizer)))
    return NULL;
  return localizer;
}

int main(void) {
  static sphc_message message;
  static sphc_localizer_frame frame;
  static sphc_localizer_result result;
  sphc_map *map = NULL;
  if (failed(sphc_map_init(view, sizeof view, board_map, (size_t)(board_map_end - board_map), &map, &message),
             message.text))
    return 1;
  sphc_localizer *localizer = make_localizer(map);
  if (!localizer) return 1;
  sphc_localizer_frame_init(&frame, sizeof frame);
  sphc_localizer_result_init(&result, sizeof result);
  while (board_wait_for_frame(&frame)) {
    if (!failed(sphc_localizer_process(localizer, &frame, &result), sphc_localizer_message(localizer)))
      board_send_result(&result);
  }
  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  return 0;
}
