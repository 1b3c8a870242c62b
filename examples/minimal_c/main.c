/* minimal_c - a map, a recording, a pose a frame; C99, and all of the library's memory in static buffers.
 *
 *     minimal_c MAP.sphc RECORDING
 */
#define _POSIX_C_SOURCE 200809L
#define SPHC_UNSTABLE 1 /* the replay driver is */
#include <drivers/replay/replay.h>
#include <fcntl.h>
#include <spherecloud/spherecloud.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>

/* Enough for every config with as many keypoints and maps, and colour images as large; sphc_map_memory and
 * sphc_localizer_memory tell the exact bytes. */
enum { KEYPOINTS = 800, MAPS = 1, WIDTH = 1280, HEIGHT = 960 };
static __attribute__((aligned(64))) char view[SPHC_MAP_BYTES_MAX],
    state[SPHC_LOCALIZER_STATE_BYTES_MAX(KEYPOINTS, MAPS)],
    scratch[SPHC_LOCALIZER_SCRATCH_BYTES_MAX(KEYPOINTS, WIDTH, HEIGHT)];
static sphc_message message;

static void check(sphc_status status, const char *what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s %s\n", what, sphc_status_name(status), message.text);
  exit(1);
}

/* The map is used in place, from wherever its bytes lie. */
static sphc_map *open_map(const char *path) {
  const int file = open(path, O_RDONLY);
  struct stat info = {0};
  const void *bytes = MAP_FAILED;
  if (file >= 0 && fstat(file, &info) == 0) {
    if (!S_ISREG(info.st_mode) || info.st_size == 0) {
      fprintf(stderr, "%s: is empty, or no file; give the map that the builder wrote\n", path);
      exit(1);
    }
    bytes = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, file, 0);
  }
  if (bytes == MAP_FAILED) {
    perror(path);
    exit(1);
  }
  sphc_map *map = NULL;
  check(sphc_map_init(view, sizeof view, bytes, (size_t)info.st_size, &map, &message), path);
  return map;
}

static sphc_localizer *make_localizer(const sphc_map *map, const sphc_replay *replay) {
  sphc_localizer_config config;
  check(sphc_localizer_config_init(&config, sizeof config), "config");
  check(sphc_replay_rig(replay, &config.rig), "rig");
  config.max_keypoints = KEYPOINTS;
  config.max_maps = MAPS;
  sphc_localizer *localizer = NULL;
  check(sphc_localizer_init(state, sizeof state, scratch, sizeof scratch, &config, &localizer, &message), "init");
  check(sphc_localizer_set_map(localizer, 0, map), sphc_localizer_message(localizer));
  return localizer;
}

int main(int argc, char **argv) {
  if (argc != 3) return fprintf(stderr, "usage: %s MAP.sphc RECORDING\n", argv[0]), 2;
  check(sphc_abi() == SPHC_ABI ? SPHC_OK : SPHC_E_UNSUPPORTED, "the library has another ABI than the header");
  sphc_replay *replay = NULL;
  check(sphc_replay_open(argv[2], NULL, NULL, &replay, &message), argv[2]);
  sphc_map *map = open_map(argv[1]);
  sphc_localizer *localizer = make_localizer(map, replay);
  for (uint32_t i = 0; i < sphc_replay_frame_count(replay); ++i) {
    sphc_localizer_frame frame;
    sphc_localizer_result result = {.struct_size = sizeof result};
    sphc_rigid pose; /* map_from_camera */
    check(sphc_replay_read_frame(replay, i, &frame, &message), "frame");
    const sphc_status status = sphc_localizer_process(localizer, &frame, &result);
    check(status, sphc_localizer_message(localizer));
    sphc_rigid_inverse(&result.camera_from_map, &pose);
    const double *t = pose.t_m, *q = pose.q_wxyz;
    if (status == SPHC_OK) {
      printf("%u at %.3f %.3f %.3f, q_wxyz %.4f %.4f %.4f %.4f\n", (unsigned)frame.sequence, t[0], t[1], t[2], q[0],
             q[1], q[2], q[3]);
    } else {
      printf("%u not localized: %s\n", (unsigned)frame.sequence, sphc_localizer_outcome_name(result.outcome));
    }
  }
  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  sphc_replay_close(&replay);
  return 0;
}
