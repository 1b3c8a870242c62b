/* A session of the C interface on made-up images, told line by line: what was found, and digests of the bytes. */
#ifndef PORTABILITY_REPLAY_H
#define PORTABILITY_REPLAY_H

#include <stddef.h>
#include <stdint.h>

#define REPLAY_LINE_BYTES 256
typedef void (*replay_line_fn)(void *user, const char *line);

/* Needs nothing but the runtime.  0: every step worked, and every pose is where the images were rendered. */
int replay_run(const void *map_file, size_t map_bytes, replay_line_fn print, void *user);

/* The same, its lines compared with those of `expected`; those that differ are printed.  0: all are equal. */
int replay_check(const void *map_file, size_t map_bytes, const char *expected, replay_line_fn print, void *user);

/* What the map was made of; make_map.cpp. */
#include "room.h"
extern const room_camera replay_color_camera;
#define REPLAY_MAP_VIEWS 3
extern const room_view replay_map_views[REPLAY_MAP_VIEWS];
extern const int32_t replay_centre_um[3]; /* of the sphere */

#endif
