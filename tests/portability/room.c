#include "room.h"

#include <stddef.h>

static const int64_t low_um[3] = {-1800000, -1500000, -1000000}, high_um[3] = {1800000, 1200000, 3000000};

/* A quaternion's rotation times its squared length: integers, exactly. */
typedef struct rotation {
  int64_t m[3][3];
  int64_t length2;
} rotation;

static rotation rotation_of(const int32_t q[4]) {
  const int64_t w = q[0], x = q[1], y = q[2], z = q[3];
  const rotation r = {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                       {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                       {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}},
                      w * w + x * x + y * y + z * z};
  return r;
}

room_view room_beside(const room_view *view, int32_t right_um) {
  const rotation r = rotation_of(view->q_wxyz);
  room_view beside = *view;
  for (int i = 0; i < 3; ++i) beside.position_um[i] += (int32_t)(r.m[i][0] * right_um / r.length2);
  return beside;
}

/* Where the ray of a pixel meets the room. */
typedef struct hit {
  int64_t at_um[3], depth_um;
  int axis;
  uint32_t wall; /* 0 to 5 */
} hit;

static hit cast(const room_camera *camera, const rotation *r, const room_view *view, int32_t column, int32_t row) {
  /* In half pixels, so that the middle of a pixel is a whole number. */
  const int64_t ray[3] = {2 * column + 1 - camera->width, 2 * row + 1 - camera->height, 2 * camera->focal_px};
  int64_t direction[3], across = 0, along = 1;
  hit found = {{0, 0, 0}, 0, 0, 0};
  for (int i = 0; i < 3; ++i) direction[i] = r->m[i][0] * ray[0] + r->m[i][1] * ray[1] + r->m[i][2] * ray[2];
  for (int i = 0; i < 3; ++i) {
    const int up = direction[i] > 0;
    const int64_t distance = up ? high_um[i] - view->position_um[i] : view->position_um[i] - low_um[i];
    const int64_t speed = up ? direction[i] : -direction[i];
    if (speed == 0 || (across > 0 && distance * along >= across * speed)) continue;
    across = distance, along = speed;
    found.axis = i;
    found.wall = (uint32_t)(2 * i + up);
  }
  for (int i = 0; i < 3; ++i) found.at_um[i] = view->position_um[i] + across * direction[i] / along;
  found.depth_um = across * r->length2 * ray[2] / along;
  return found;
}

static uint32_t hash(uint32_t x, uint32_t y, uint32_t salt) {
  uint32_t h = x * 0x8DA6B343u ^ y * 0xD8163841u ^ salt * 0xCB1AB31Fu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return (h ^ (h >> 15)) & 0xFFFF;
}

/* 3 f^2 - 2 f^3, of 65536. */
static uint32_t smooth(uint32_t f) { return (uint32_t)(((uint64_t)f * f >> 16) * (3 * 65536 - 2 * f) >> 16); }

static uint32_t blend(uint32_t a, uint32_t b, uint32_t f) {
  return (uint32_t)(((uint64_t)a * (65536 - f) + (uint64_t)b * f) >> 16);
}

/* Smooth noise of 16 bits with square cells. */
static uint32_t noise(uint32_t x_um, uint32_t y_um, uint32_t cell_um, uint32_t salt) {
  const uint32_t x = x_um / cell_um, y = y_um / cell_um;
  const uint32_t fx = smooth((uint32_t)(((uint64_t)(x_um % cell_um) << 16) / cell_um));
  const uint32_t fy = smooth((uint32_t)(((uint64_t)(y_um % cell_um) << 16) / cell_um));
  return blend(blend(hash(x, y, salt), hash(x + 1, y, salt), fx),
               blend(hash(x, y + 1, salt), hash(x + 1, y + 1, salt), fx), fy);
}

static uint8_t shade(const hit *at, uint32_t room) {
  static const uint32_t cells_um[4] = {310000, 130000, 55000, 28000}, weights[4] = {64, 77, 77, 38}; /* of 256 */
  const uint32_t u_um = (uint32_t)(at->at_um[(at->axis + 1) % 3] + 4000000);
  const uint32_t v_um = (uint32_t)(at->at_um[(at->axis + 2) % 3] + 4000000);
  uint32_t sum = 0;
  for (uint32_t k = 0; k < 4; ++k)
    sum += weights[k] * noise(u_um, v_um, cells_um[k], (room * 6 + at->wall) * 8 + k);
  return (uint8_t)(20 + (((sum >> 8) * 215) >> 16));
}

void room_render_gray(const room_camera *camera, const room_view *view, uint32_t room, uint8_t *gray) {
  const rotation r = rotation_of(view->q_wxyz);
  for (int32_t y = 0; y < camera->height; ++y)
    for (int32_t x = 0; x < camera->width; ++x) {
      const hit at = cast(camera, &r, view, x, y);
      *gray++ = shade(&at, room);
    }
}

void room_render_depth(const room_camera *camera, const room_view *view, uint16_t *depth_mm) {
  const rotation r = rotation_of(view->q_wxyz);
  for (int32_t y = 0; y < camera->height; ++y)
    for (int32_t x = 0; x < camera->width; ++x)
      *depth_mm++ = (uint16_t)((cast(camera, &r, view, x, y).depth_um + 500) / 1000);
}
