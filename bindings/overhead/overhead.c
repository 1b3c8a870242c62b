/* The golden session through the C interface: for each line that comes in, a line with the processor time
 * of each frame, in nanoseconds, and that of a prediction.
 *
 *     overhead FOLDER */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <spherecloud/spherecloud.h>

enum { FRAMES = 10, PREDICTIONS = 1000 };
static uint8_t color[FRAMES][320 * 240];
static uint16_t depth[FRAMES][200 * 160];
static uint64_t map_file[1 << 18];

static int64_t read_clock(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static int64_t now_ns(void *user) {
  (void)user;
  return read_clock(CLOCK_MONOTONIC);
}

/* Of this thread alone, so that other programs count little. */
static int64_t used_ns(void) { return read_clock(CLOCK_THREAD_CPUTIME_ID); }

static void must(sphc_status status, const char *text) {
  if (status >= 0) return;
  fprintf(stderr, "overhead: %s\n", text);
  exit(1);
}

static size_t read_file(const char *folder, const char *name, void *bytes, size_t room) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "rb");
  const size_t size = file ? fread(bytes, 1, room, file) : 0;
  if (!size) must(SPHC_E_DEVICE, path);
  fclose(file);
  return size;
}

static void read_images(const char *folder) {
  for (int i = 0; i < FRAMES; ++i) {
    char name[32];
    snprintf(name, sizeof name, "color_%02d.gray8", i);
    read_file(folder, name, color[i], sizeof color[i]);
    snprintf(name, sizeof name, "depth_%02d.depth16", i);
    read_file(folder, name, depth[i], sizeof depth[i]);
  }
}

static sphc_camera pinhole(uint32_t width, uint32_t height, double focal_px) {
  const sphc_camera made = {SPHC_CAMERA_PINHOLE, width, height, 4, {focal_px, focal_px, width / 2.0, height / 2.0}};
  return made;
}

static void *memory(uint64_t bytes) {
  void *made = NULL;
  return posix_memalign(&made, 64, (size_t)bytes) ? NULL : made;
}

static sphc_localizer *make(const sphc_map *map) {
  sphc_localizer_config config;
  sphc_message message = {""};
  sphc_localizer *localizer = NULL;
  sphc_memory need;
  sphc_localizer_config_init(&config, sizeof config);
  config.rig.color_camera = pinhole(320, 240, 250);
  config.rig.depth_camera = pinhole(200, 160, 140);
  config.rig.color_from_depth.t_m[0] = 0.04;
  config.clock = now_ns;
  must(sphc_localizer_memory(&config, &need, &message), message.text);
  must(sphc_localizer_init(memory(need.state_bytes), (size_t)need.state_bytes, memory(need.scratch_bytes),
                           (size_t)need.scratch_bytes, &config, &localizer, &message),
       message.text);
  must(sphc_localizer_set_map(localizer, 0, map), "set_map");
  return localizer;
}

static void play(sphc_localizer *localizer, sphc_localizer_frame *frame, sphc_localizer_result *result) {
  sphc_localizer_prediction prediction;
  sphc_localizer_prediction_init(&prediction, sizeof prediction);
  sphc_localizer_reset(localizer);
  for (int i = 0; i < FRAMES; ++i) {
    const int64_t before = used_ns();
    frame->color_time_ns = frame->depth_time_ns = 1000000000 + INT64_C(33000000) * i;
    frame->color = (sphc_image){color[i], 320, 240, 320, SPHC_FORMAT_GRAY8};
    frame->depth = (sphc_image){depth[i], 200, 160, 400, SPHC_FORMAT_DEPTH16};
    must(sphc_localizer_process(localizer, frame, result), sphc_localizer_message(localizer));
    printf("%" PRId64 " ", used_ns() - before);
  }
  const int64_t before = used_ns();
  for (int i = 0; i < PREDICTIONS; ++i) {
    must(sphc_localizer_predict(localizer, frame->color_time_ns + i, &prediction), "predict");
  }
  printf("%" PRId64 "\n", (used_ns() - before) / PREDICTIONS);
  fflush(stdout);
}

int main(int count, char **words) {
  if (count != 2) must(SPHC_E_ARGUMENT, "usage: overhead FOLDER");
  sphc_message message = {""};
  sphc_map *map = NULL;
  sphc_localizer_frame frame;
  sphc_localizer_result result;
  read_images(words[1]);
  const size_t bytes = read_file(words[1], "room.sphc", map_file, sizeof map_file);
  sphc_memory need;
  sphc_map_memory(&need);
  must(sphc_map_init(memory(need.state_bytes), (size_t)need.state_bytes, map_file, bytes, &map, &message),
       message.text);
  sphc_localizer *localizer = make(map);
  sphc_localizer_frame_init(&frame, sizeof frame);
  sphc_localizer_result_init(&result, sizeof result);
  char line[16];
  while (fgets(line, sizeof line, stdin)) play(localizer, &frame, &result);
  return 0;
}
