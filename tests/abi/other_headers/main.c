/* A frame, localized by programs of two headers with one library: both get the same pose. */
#include <stdio.h>
#include <string.h>

#include "data.h"
#include "replay.h"
#include "session.h"

enum { DEPTH_WIDTH = 200, DEPTH_HEIGHT = 160, BASELINE_UM = 40000 };
static uint8_t gray[320 * 240];
static uint16_t depth_mm[DEPTH_HEIGHT * DEPTH_WIDTH];

static sphc_camera pinhole(const room_camera *from) {
  sphc_camera camera = {SPHC_CAMERA_PINHOLE, (uint32_t)from->width, (uint32_t)from->height, 4, {0}};
  camera.params[0] = camera.params[1] = from->focal_px;
  camera.params[2] = from->width / 2.0;
  camera.params[3] = from->height / 2.0;
  return camera;
}

static sphc_image image(const void *data, const sphc_camera *camera, sphc_format format) {
  const sphc_image made = {data, camera->width, camera->height, camera->width * sphc_format_bytes(format), format};
  return made;
}

static seen look(void) {
  const room_camera depth_camera = {DEPTH_WIDTH, DEPTH_HEIGHT, 140};
  const room_view *view = &replay_map_views[1], beside = room_beside(view, BASELINE_UM);
  seen what;
  what.file = data_map;
  what.file_bytes = (size_t)(data_map_end - data_map);
  sphc_rig_init(&what.rig);
  what.rig.color_camera = pinhole(&replay_color_camera);
  what.rig.depth_camera = pinhole(&depth_camera);
  what.rig.color_from_depth.t_m[0] = BASELINE_UM / 1e6;
  room_render_gray(&replay_color_camera, view, 0, gray);
  room_render_depth(&depth_camera, &beside, depth_mm);
  what.color = image(gray, &what.rig.color_camera, SPHC_FORMAT_GRAY8);
  what.depth = image(depth_mm, &what.rig.depth_camera, SPHC_FORMAT_DEPTH16);
  return what;
}

int main(void) {
  const seen what = look();
  sphc_rigid today, other;
  int line = session_of_today(&what, &today);
  if (line) return printf("today's session fails in line %d\n", line), 1;
  line = session_of_another(&what, &other);
  if (line) return printf("the other session fails in line %d\n", line), 1;
  if (memcmp(&today, &other, sizeof today) != 0) return printf("the other session has another pose\n"), 1;
  return 0;
}
