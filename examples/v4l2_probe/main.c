/* v4l2_probe - what cameras are there, and what one of them sends.
 *
 *     v4l2_probe                                              lists the cameras
 *     v4l2_probe CAMERA color|depth [WIDTH HEIGHT [FPS [COUNT]]]
 *
 * CAMERA is "/dev/videoN", "card=NAME" or "bus=PLUG".  Takes what the camera makes of the wish, prints COUNT
 * captures (30), then what was lost.  Exit status 0: every capture came.
 */
#define SPHC_UNSTABLE 1 /* what captures is */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "drivers/v4l2/v4l2.h"

static const char *const kTimePoints[] = {"middle", "start", "end", "arrival"};

static void printFourcc(uint32_t fourcc) {
  for (int i = 0; i < 4; ++i) putchar((int)(fourcc >> 8 * i & 0x7f)); /* the top bit means big-endian */
  fputs(fourcc >> 31 ? "(BE) " : " ", stdout);
}

static int listCameras(void) {
  static sphc_v4l2_device devices[64];
  uint32_t count = 0;
  sphc_v4l2_list(devices, 64, &count);
  for (uint32_t i = 0; i < count && i < 64; ++i) {
    const sphc_v4l2_device *device = &devices[i];
    printf("%-12s card=%s bus=%s%s%s ", device->node, device->card, device->bus, device->can_color ? " color" : "",
           device->can_depth ? " depth" : "");
    for (uint32_t f = 0; f < device->fourcc_count; ++f) printFourcc(device->fourccs[f]);
    printf("%s%s\n", device->problem[0] ? "  problem: " : "", device->problem);
  }
  printf("%u cameras\n", (unsigned)count);
  return 0;
}

static int fail(const char *what, sphc_status status, const char *text) {
  fprintf(stderr, "%s: %s: %s\n", what, sphc_status_name(status), text);
  return 1;
}

static void printMode(const sphc_v4l2 *camera) {
  sphc_v4l2_mode mode;
  mode.struct_size = sizeof mode;
  sphc_v4l2_get_mode(camera, &mode);
  printFourcc(mode.fourcc);
  printf("of %s (%s, %s): %u x %u, stride %u, %u/%u s a frame, %u buffers%s%s\n", mode.node, mode.card, mode.bus,
         (unsigned)mode.width, (unsigned)mode.height, (unsigned)mode.stride_bytes, (unsigned)mode.period_numerator,
         (unsigned)mode.period_denominator, (unsigned)mode.buffers, mode.zero_copy ? ", lent without a copy" : "",
         mode.adjusted ? ", not as asked" : "");
}

static void printCapture(const sphc_capture *capture) {
  printf("%6u  time %lld ns (%s), sigma %u us, exposure %u us, arrived %+.3f ms later\n",
         (unsigned)capture->sequence, (long long)capture->time_ns, kTimePoints[capture->time_point],
         (unsigned)capture->time_sigma_us, (unsigned)capture->exposure_us,
         (double)(capture->arrival_ns - capture->time_ns) * 1e-6);
}

static void printStats(const sphc_v4l2 *camera) {
  sphc_v4l2_stats stats;
  stats.struct_size = sizeof stats;
  sphc_v4l2_get_stats(camera, &stats);
  printf(
      "captured %llu, lost %llu, corrupt %llu, short %llu, duplicated %llu, uncounted %llu, time replaced %llu, "
      "time "
      "refused %llu, starved %llu, errors %llu\n",
      (unsigned long long)stats.captured, (unsigned long long)stats.lost, (unsigned long long)stats.corrupt,
      (unsigned long long)stats.short_frames, (unsigned long long)stats.duplicated,
      (unsigned long long)stats.uncounted, (unsigned long long)stats.time_replaced,
      (unsigned long long)stats.time_refused, (unsigned long long)stats.starved,
      (unsigned long long)stats.device_errors);
}

static int captureSome(sphc_v4l2 *camera, int count) {
  sphc_source source;
  sphc_v4l2_source(camera, &source);
  sphc_status status = source.start(source.self);
  if (status < 0) return fail("start", status, source.message(source.self));
  for (int i = 0; i < count && status == SPHC_OK; ++i) {
    sphc_capture capture;
    memset(&capture, 0, sizeof capture);
    capture.struct_size = sizeof capture;
    status = source.acquire(source.self, 2000000, &capture);
    if (status != SPHC_OK) break;
    printCapture(&capture);
    source.release(source.self, &capture);
  }
  const int failed = status == SPHC_OK ? 0 : fail("acquire", status, source.message(source.self));
  source.stop(source.self);
  return failed;
}

int main(int argc, char **argv) {
  if (argc == 1) return listCameras();
  const int known = argc > 2 && (!strcmp(argv[2], "color") || !strcmp(argv[2], "depth"));
  const int count = argc > 6 ? atoi(argv[6]) : 30;
  if (!known || argc == 4 || argc > 7 || count < 1) {
    fprintf(stderr, "usage: %s [CAMERA color|depth [WIDTH HEIGHT [FPS [COUNT]]]]\n", argv[0]);
    return 2;
  }
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = strcmp(argv[2], "depth") == 0 ? SPHC_STREAM_DEPTH : SPHC_STREAM_COLOR;
  config.allow_adjusting = 1;
  if (argc > 4) config.width = (uint32_t)atoi(argv[3]), config.height = (uint32_t)atoi(argv[4]);
  if (argc > 5) config.fps = (uint32_t)atoi(argv[5]);
  sphc_v4l2 *camera = NULL;
  sphc_message message = {""};
  const sphc_status status = sphc_v4l2_open(argv[1], &config, &camera, &message);
  if (status < 0) return fail("open", status, message.text);
  printMode(camera);
  const int failed = captureSome(camera, count);
  printStats(camera);
  sphc_v4l2_close(&camera);
  return failed;
}
