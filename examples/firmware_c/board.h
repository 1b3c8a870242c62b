/* What main.c wants of a board.  Write one board.c for yours. */
#ifndef FIRMWARE_C_BOARD_H
#define FIRMWARE_C_BOARD_H

#include <spherecloud/spherecloud.h>

/* Sizes of the images: the compiler reserves the library's memory by them. */
#define BOARD_COLOR_WIDTH 320
#define BOARD_COLOR_HEIGHT 240

/* The map file, aligned to 8 bytes.  It is used where it lies, so it may stay in flash. */
extern const uint8_t board_map[], board_map_end[];

/* Monotonic, in nanoseconds. */
int64_t board_time_ns(void *user);
/* What the calibration of the two cameras says. */
void board_rig(sphc_rig *rig);
/* Waits for the next pair of images and sets times and images of the frame, which stay readable until the next
 * call.  0: there are no more. */
int board_wait_for_frame(sphc_localizer_frame *frame);
void board_send_result(const sphc_localizer_result *result);
void board_send_failure(const char *status_name, const char *text);

#endif
