/* sensor_c - frames of a sensor driver of your own to poses, and kept as a raw recording, of which the workstation
 * makes maps; C99, and all of the library's memory in static buffers.
 *
 *     sensor_c MAP.sphc WALK.raw [KEPT.raw]
 *
 * Here a raw recording plays the sensor (spherecloud convert walk walk.raw --to raw).  Put your driver in the place
 * of what stands under "the sensor": open_sensor, wait_for_exposures, and what they keep; the rest stays.
 */
#define _POSIX_C_SOURCE 200809L
#include <drivers/raw/raw.h>
#include <drivers/raw/raw_writer.h>
#include <errno.h>
#include <spherecloud/spherecloud.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The largest that there is room for; more is refused. */
enum { KEYPOINTS = 800, MAPS = 1, WIDTH = 1280, HEIGHT = 960, MAP_BYTES = 16 << 20, FRAME_BYTES = 8 << 20 };
static __attribute__((aligned(64))) uint8_t view[SPHC_MAP_BYTES_MAX],
    state[SPHC_LOCALIZER_STATE_BYTES_MAX(KEYPOINTS, MAPS)],
    scratch[SPHC_LOCALIZER_SCRATCH_BYTES_MAX(KEYPOINTS, WIDTH, HEIGHT)], map_file[MAP_BYTES];
static sphc_message message;

static void check(sphc_status status, const char *text) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", sphc_status_name(status), text);
  exit(1);
}

static void fail(const char *path, const char *why) {
  fprintf(stderr, "%s: %s\n", path, why);
  exit(1);
}

static FILE *opened(const char *path, const char *mode) {
  FILE *file = fopen(path, mode);
  if (!file) fail(path, strerror(errno));
  return file;
}

/* ---- the sensor: yours ---- */

/* What a driver gives for a pair of exposures, in its own words: buffers of its own, which stay until the next
 * pair, and when each exposure began, by one clock. */
typedef struct exposures {
  const void *color, *depth;
  uint32_t color_stride_bytes, depth_stride_bytes;
  int64_t color_begin_ns, color_exposure_ns, depth_begin_ns, depth_exposure_ns;
} exposures;

typedef struct sensor {
  sphc_rig rig; /* as it is calibrated */
  sphc_format color_format;
  /* what plays the sensor */
  sphc_raw raw;
  uint32_t next;
  uint16_t memory[FRAME_BYTES / 2];
} sensor;

static int read_file(void *file, uint64_t offset, void *out, size_t bytes) {
  return fseek(file, (long)offset, SEEK_SET) || fread(out, 1, bytes, file) != bytes;
}

static void open_sensor(sensor *from, const char *path) {
  FILE *file = opened(path, "rb");
  const long bytes = fseek(file, 0, SEEK_END) ? -1 : ftell(file);
  if (bytes < 0) fail(path, "is no file whose length can be told; copy it to a disk");
  check(sphc_raw_open(&from->raw, read_file, file, (uint64_t)bytes, &message), message.text);
  from->rig = from->raw.rig;
  from->color_format = from->raw.color_format;
}

/* 0: there are no more. */
static int wait_for_exposures(sensor *from, exposures *pair) {
  const int64_t exposure_ns = 8000000;
  sphc_raw_frame recorded;
  if (from->next == from->raw.frame_count) return 0;
  check(sphc_raw_read_frame(&from->raw, from->next++, from->memory, sizeof from->memory, &recorded, &message),
        message.text);
  const sphc_localizer_frame *frame = &recorded.frame;
  *pair = (exposures){frame->color.data,
                      frame->depth.data,
                      frame->color.stride_bytes,
                      frame->depth.stride_bytes,
                      frame->color_time_ns - exposure_ns / 2,
                      exposure_ns,
                      frame->depth_time_ns - exposure_ns / 2,
                      exposure_ns};
  return 1;
}

/* ---- from the sensor to the localizer ---- */

/* Images stay where the sensor put them, with its stride; times are those of the middle of an exposure. */
static void fill_frame(const exposures *pair, const sensor *from, sphc_localizer_frame *frame) {
  const sphc_camera *color = &from->rig.color_camera, *depth = &from->rig.depth_camera;
  ++frame->sequence;
  frame->color_time_ns = pair->color_begin_ns + pair->color_exposure_ns / 2;
  frame->depth_time_ns = pair->depth_begin_ns + pair->depth_exposure_ns / 2;
  frame->color =
      (sphc_image){pair->color, color->width, color->height, pair->color_stride_bytes, from->color_format};
  frame->depth =
      (sphc_image){pair->depth, depth->width, depth->height, pair->depth_stride_bytes, SPHC_FORMAT_DEPTH16};
}

static sphc_localizer *make_localizer(const char *map_path, const sphc_rig *rig) {
  FILE *file = opened(map_path, "rb");
  const size_t map_bytes = fread(map_file, 1, sizeof map_file, file);
  if (fgetc(file) != EOF) fail(map_path, "is larger than there is room for; raise MAP_BYTES");
  fclose(file);
  sphc_map *map = NULL; /* lives as long as the program, as the localizer does */
  sphc_localizer *localizer = NULL;
  sphc_localizer_config config;
  check(sphc_map_init(view, sizeof view, map_file, map_bytes, &map, &message), message.text);
  check(sphc_localizer_config_init(&config, sizeof config), "config");
  config.rig = *rig;
  config.max_keypoints = KEYPOINTS;
  config.max_maps = MAPS;
  check(sphc_localizer_init(state, sizeof state, scratch, sizeof scratch, &config, &localizer, &message),
        message.text);
  check(sphc_localizer_set_map(localizer, 0, map), sphc_localizer_message(localizer));
  return localizer;
}

/* ---- what is kept ---- */

/* By whatever names: opening the file would empty it. */
static int same_file(const char *one, const char *other) {
  struct stat a, b;
  return stat(one, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

static int write_file(void *file, uint64_t offset, const void *bytes, size_t count) {
  return fseek(file, (long)offset, SEEK_SET) || fwrite(bytes, 1, count, file) != count;
}

/* With its pose where there is one, in the frame of the map. */
static void keep(sphc_raw_writer *writer, const sphc_localizer_frame *frame, const sphc_rigid *map_from_camera) {
  check(sphc_raw_writer_add(writer, frame, map_from_camera, &message), message.text);
  /* So the file is whole after each frame, as far as it has reached the disk: sync it as often as you need. */
  check(sphc_raw_writer_finish(writer, &message), message.text);
}

int main(int argc, char **argv) {
  static sensor from;
  static sphc_raw_writer writer;
  if (argc != 3 && argc != 4) return fprintf(stderr, "usage: %s MAP.sphc WALK.raw [KEPT.raw]\n", argv[0]), 2;
  if (argc == 4 && same_file(argv[2], argv[3])) fail(argv[3], "plays the sensor; keep the frames in another file");
  if (argc == 4 && same_file(argv[1], argv[3])) fail(argv[3], "is the map; keep the frames in another file");
  open_sensor(&from, argv[2]);
  const sphc_rig *rig = &from.rig;
  sphc_localizer *localizer = make_localizer(argv[1], rig);
  FILE *kept = argc == 4 ? opened(argv[3], "wb") : NULL;
  if (kept) check(sphc_raw_writer_begin(&writer, write_file, kept, rig, from.color_format, &message), message.text);
  exposures pair;
  sphc_localizer_frame frame;
  sphc_localizer_result result;
  sphc_localizer_frame_init(&frame, sizeof frame);
  sphc_localizer_result_init(&result, sizeof result);
  while (wait_for_exposures(&from, &pair)) {
    fill_frame(&pair, &from, &frame);
    const sphc_status status = sphc_localizer_process(localizer, &frame, &result);
    check(status, sphc_localizer_message(localizer));
    sphc_rigid map_from_camera;
    sphc_rigid_inverse(&result.camera_from_map, &map_from_camera);
    if (kept) keep(&writer, &frame, status == SPHC_OK ? &map_from_camera : NULL);
    const double *t = map_from_camera.t_m;
    if (status == SPHC_OK)
      printf("%u at %.3f %.3f %.3f\n", (unsigned)frame.sequence, t[0], t[1], t[2]);
    else
      printf("%u not localized: %s\n", (unsigned)frame.sequence, sphc_localizer_outcome_name(result.outcome));
  }
  if (kept && fclose(kept)) fail(argv[3], strerror(errno));
  sphc_localizer_fini(&localizer);
  return 0;
}
