/* live_c - two V4L2 cameras, a map, a pose a frame; C99, nothing allocated once the cameras run.
 *
 *     live_c /dev/video0 /dev/video2 CALIBRATION.json MAP.sphc [FRAMES]
 *
 * Colour first, depth second; a node, or "card=NAME".  Ends after FRAMES pairs, or never.
 */
#define _POSIX_C_SOURCE 200809L
#define SPHC_UNSTABLE 1 /* what captures is */
#include <drivers/replay/replay.h>
#include <drivers/v4l2/v4l2.h>
#include <fcntl.h>
#include <spherecloud/spherecloud_capture.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>

/* Enough for every config with as many keypoints and maps, and colour images as large; the _memory functions tell
 * the exact bytes. */
enum { KEYPOINTS = 800, MAPS = 1, WIDTH = 1280, HEIGHT = 960 };
static __attribute__((aligned(64))) char view[SPHC_MAP_BYTES_MAX],
    state[SPHC_LOCALIZER_STATE_BYTES_MAX(KEYPOINTS, MAPS)],
    scratch[SPHC_LOCALIZER_SCRATCH_BYTES_MAX(KEYPOINTS, WIDTH, HEIGHT)], pairs[SPHC_PAIRER_BYTES_MAX];
static sphc_message message;

struct camera {
  sphc_v4l2 *handle;
  sphc_source source;
};

static void check(sphc_status status, const char *what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s %s\n", what, sphc_status_name(status), message.text);
  exit(1);
}

static struct camera open_camera(const char *name, sphc_stream stream, const sphc_camera *lens) {
  struct camera camera;
  sphc_v4l2_config config;
  check(sphc_v4l2_config_init(&config, sizeof config), "camera config");
  config.stream = stream;
  config.width = lens->width;
  config.height = lens->height;
  config.fps = 0; /* whatever the camera does */
  config.buffers = 8;
  config.loan_limit = 6; /* more than the pairer has slots */
  check(sphc_v4l2_open(name, &config, &camera.handle, &message), name);
  check(sphc_v4l2_source(camera.handle, &camera.source), name);
  check(camera.source.start(camera.source.self), camera.source.message(camera.source.self));
  return camera;
}

static sphc_map *open_map(const char *path) {
  const int file = open(path, O_RDONLY);
  struct stat info = {0};
  const void *bytes = MAP_FAILED;
  if (file >= 0 && fstat(file, &info) == 0) {
    if (!S_ISREG(info.st_mode) || info.st_size == 0) {
      fprintf(stderr, "%s: is empty, or no file; give the map that the builder wrote\n", path);
      exit(EXIT_FAILURE);
    }
    bytes = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, file, 0);
  }
  if (bytes == MAP_FAILED) {
    perror(path);
    exit(EXIT_FAILURE);
  }
  sphc_map *map = NULL;
  check(sphc_map_init(view, sizeof view, bytes, (size_t)info.st_size, &map, &message), path);
  return map;
}

static sphc_localizer *make_localizer(const sphc_map *map, const sphc_rig *rig) {
  sphc_localizer_config config;
  sphc_localizer *localizer = NULL;
  check(sphc_localizer_config_init(&config, sizeof config), "config");
  config.rig = *rig;
  config.max_keypoints = KEYPOINTS;
  config.max_maps = MAPS;
  check(sphc_localizer_init(state, sizeof state, scratch, sizeof scratch, &config, &localizer, &message),
        "localizer");
  check(sphc_localizer_set_map(localizer, 0, map), sphc_localizer_message(localizer));
  return localizer;
}

/* One capture, where there is one within 2 ms, goes to the pairer; its loan goes with it. */
static void feed(const struct camera *camera, sphc_pairer *pairer) {
  sphc_capture capture = {.struct_size = sizeof capture};
  const sphc_status status = camera->source.acquire(camera->source.self, 2000, &capture);
  if (status == SPHC_E_DEVICE_LOST) check(status, camera->source.message(camera->source.self));
  if (status < 0) fprintf(stderr, "%s\n", camera->source.message(camera->source.self)); /* and go on */
  if (status != SPHC_OK || sphc_pairer_push(pairer, &capture) == SPHC_OK) return;
  fprintf(stderr, "a capture is left out: its time is before the last one's, or on another clock\n");
  camera->source.release(camera->source.self, &capture);
}

static void localize(sphc_localizer *localizer, const sphc_capture *color, const sphc_capture *depth) {
  const sphc_localizer_frame frame = {.struct_size = sizeof frame,
                                      .sequence = color->sequence,
                                      .color_time_ns = sphc_capture_middle_ns(color),
                                      .depth_time_ns = sphc_capture_middle_ns(depth),
                                      .color = color->image,
                                      .depth = depth->image};
  sphc_localizer_result result = {.struct_size = sizeof result};
  sphc_rigid pose; /* map_from_camera */
  const sphc_status status = sphc_localizer_process(localizer, &frame, &result);
  check(status, sphc_localizer_message(localizer));
  sphc_rigid_inverse(&result.camera_from_map, &pose);
  if (status == SPHC_OK)
    printf("%u at %.3f %.3f %.3f, confidence %.2f\n", (unsigned)frame.sequence, pose.t_m[0], pose.t_m[1],
           pose.t_m[2], result.confidence);
  else
    printf("%u not localized: %s\n", (unsigned)frame.sequence, sphc_localizer_outcome_name(result.outcome));
}

int main(int argc, char **argv) {
  char *after = NULL; /* the number */
  const long frames = argc > 5 ? strtol(argv[5], &after, 10) : -1;
  if (argc < 5 || argc > 6 || (argc == 6 && (*after || frames < 1)))
    return fprintf(stderr, "usage: %s COLOR DEPTH CALIBRATION MAP [FRAMES]\n", argv[0]), 2;
  check(sphc_abi() == SPHC_ABI ? SPHC_OK : SPHC_E_UNSUPPORTED, "the library has another ABI than the header");
  sphc_rig rig;
  check(sphc_calibration_read(argv[3], &rig, &message), argv[3]);
  sphc_map *map = open_map(argv[4]);
  sphc_localizer *localizer = make_localizer(map, &rig);
  struct camera color = open_camera(argv[1], SPHC_STREAM_COLOR, &rig.color_camera);
  struct camera depth = open_camera(argv[2], SPHC_STREAM_DEPTH, &rig.depth_camera);
  sphc_pairer_config config;
  sphc_pairer *pairer = NULL;
  check(sphc_pairer_config_init(&config, sizeof config), "pairer config");
  config.tolerance_ns = 34000000; /* nobody synchronises two webcams: half a period at 15 Hz */
  check(sphc_pairer_init(pairs, sizeof pairs, &config, &pairer, &message), "pairer");

  for (long done = 0; done != frames;) {
    sphc_capture of_color, of_depth, dropped;
    const sphc_status status = sphc_pairer_pop(pairer, &of_color, &of_depth, &dropped);
    if (status == SPHC_OK) {
      localize(localizer, &of_color, &of_depth);
      color.source.release(color.source.self, &of_color);
      depth.source.release(depth.source.self, &of_depth);
      ++done;
    } else if (dropped.stream != SPHC_STREAM_NONE) {
      const struct camera *from = dropped.stream == SPHC_STREAM_COLOR ? &color : &depth;
      from->source.release(from->source.self, &dropped);
    } else {
      feed(&color, pairer);
      feed(&depth, pairer);
    }
  }
  sphc_v4l2_close(&color.handle);
  sphc_v4l2_close(&depth.handle);
  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  return 0;
}
