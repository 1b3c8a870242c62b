/* A room of textured walls, ray-cast in integers alone: the same images on every machine. */
#ifndef PORTABILITY_ROOM_H
#define PORTABILITY_ROOM_H

#include <stdint.h>

typedef struct room_camera {
  int32_t width, height, focal_px; /* a pinhole; its axis passes through the middle of the image */
} room_camera;

/* world_from_camera; x right, y down, z forward. */
typedef struct room_view {
  int32_t q_wxyz[4];      /* of any length; parts within +- 1024 */
  int32_t position_um[3]; /* inside the room: +- 1.7 m, +- 1.1 m, -0.9 m to 2.9 m */
} room_view;

/* The view of a camera that stands `right_um` to the right of this one. */
room_view room_beside(const room_view *view, int32_t right_um);

/* width * height pixels; rooms of different numbers have other walls. */
void room_render_gray(const room_camera *camera, const room_view *view, uint32_t room, uint8_t *gray);
void room_render_depth(const room_camera *camera, const room_view *view, uint16_t *depth_mm);

#endif
