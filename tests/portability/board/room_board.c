/* The board that examples/firmware_c runs on in tests: its cameras look at the made-up room.  What is sent is
 * compared with where the images were rendered. */
#include <examples/firmware_c/board.h>
#include <stdio.h>
#include <stdlib.h>

#include "../room.h"

enum { FRAMES = 4, DEPTH_WIDTH = 200, DEPTH_HEIGHT = 160, DEPTH_RIGHT_UM = 40000 };
static const room_camera color_camera = {BOARD_COLOR_WIDTH, BOARD_COLOR_HEIGHT, 250},
                         depth_camera = {DEPTH_WIDTH, DEPTH_HEIGHT, 140};
static const int32_t centre_um[3] = {100000, -200000, 1200000}; /* of the map's sphere */
static uint8_t gray[BOARD_COLOR_WIDTH * BOARD_COLOR_HEIGHT];
static uint16_t depth[DEPTH_WIDTH * DEPTH_HEIGHT];
static room_view shown;
static uint32_t frames, found;

__asm__(
    ".section .rodata\n"
    ".balign 8\n"
    ".globl board_map\n"
    ".globl board_map_end\n"
    "board_map:\n"
    ".incbin \"" DATA_FOLDER
    "/room.sphc\"\n"
    "board_map_end:\n"
    ".byte 0\n"
    ".text\n");

static void set_pinhole(sphc_camera *camera, const room_camera *of) {
  camera->model = SPHC_CAMERA_PINHOLE;
  camera->width = (uint32_t)of->width;
  camera->height = (uint32_t)of->height;
  camera->param_count = 4;
  camera->params[0] = camera->params[1] = of->focal_px;
  camera->params[2] = of->width / 2.0;
  camera->params[3] = of->height / 2.0;
}

int64_t board_time_ns(void *user) {
  static int64_t calls;
  (void)user;
  return 1000 * ++calls;
}

void board_rig(sphc_rig *rig) {
  set_pinhole(&rig->color_camera, &color_camera);
  set_pinhole(&rig->depth_camera, &depth_camera);
  rig->color_from_depth.t_m[0] = DEPTH_RIGHT_UM / 1e6;
}

int board_wait_for_frame(sphc_localizer_frame *frame) {
  const int32_t i = (int32_t)frames;
  const room_view view = {{1000, 2 + 2 * i, 22 - 4 * i, 2 + i}, {-90000 + 10000 * i, -4000 * i, 8000 * i}};
  const room_view beside = room_beside(&view, DEPTH_RIGHT_UM);
  if (frames == FRAMES) {
    if (found != FRAMES) exit(1);
    return 0;
  }
  ++frames;
  shown = view;
  room_render_gray(&color_camera, &view, 0, gray);
  room_render_depth(&depth_camera, &beside, depth);
  frame->sequence = frames;
  frame->color_time_ns = frame->depth_time_ns = 33000000 * (int64_t)frames;
  frame->color = (sphc_image){gray, BOARD_COLOR_WIDTH, BOARD_COLOR_HEIGHT, BOARD_COLOR_WIDTH, SPHC_FORMAT_GRAY8};
  frame->depth = (sphc_image){depth, DEPTH_WIDTH, DEPTH_HEIGHT, 2 * DEPTH_WIDTH, SPHC_FORMAT_DEPTH16};
  return 1;
}

void board_send_result(const sphc_localizer_result *result) {
  sphc_rigid map_from_camera;
  sphc_rigid_inverse(&result->camera_from_map, &map_from_camera);
  printf("frame %u: %s", (unsigned)result->sequence, sphc_localizer_outcome_name(result->outcome));
  int is_right = result->outcome == SPHC_OUTCOME_LOCALIZED;
  for (int i = 0; i < 3; ++i) {
    const int found_mm = (int)(map_from_camera.t_m[i] * 1e3),
              shown_mm = (shown.position_um[i] - centre_um[i]) / 1000;
    printf(" %d", found_mm);
    is_right = is_right && abs(found_mm - shown_mm) <= 20;
  }
  printf(" mm%s\n", is_right ? "" : ", which is wrong");
  found += (uint32_t)is_right;
}

void board_send_failure(const char *status_name, const char *text) {
  printf("%s: %s\n", status_name, text);
  exit(1);
}
