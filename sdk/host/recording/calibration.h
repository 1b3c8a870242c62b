/* calibration.h - the calibration of a colour and depth camera pair, and its file (docs/drivers.md has the format).
 *
 * Conventions (frames, units, pixels, memory, failure, thread classes) are those of spherecloud.h.  These functions
 * read and write files and allocate while they run; no C++ exception leaves them.
 */
#ifndef SPHERECLOUD_HOST_RECORDING_CALIBRATION_H
#define SPHERECLOUD_HOST_RECORDING_CALIBRATION_H

#include <spherecloud/spherecloud.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What sphc_config needs to know about the cameras; pixel centres at 0.5 as in spherecloud.h.
 * Equal cameras with the identity between them: the depth image is already registered to colour. */
typedef struct sphc_calibration {
  uint32_t struct_size;
  uint32_t reserved;
  sphc_camera color_camera;
  sphc_camera depth_camera;
  sphc_rigid color_from_depth; /* x_color = R x_depth + t, metres */
  double depth_unit_m;         /* metres per unit of the depth image */
} sphc_calibration;

/* Identity, 0.001 m a unit, cameras all zero (to be set); sets struct_size.  Errors: ARGUMENT, STRUCT_SIZE. [pure]
 */
sphc_status sphc_calibration_init(sphc_calibration *calibration, size_t struct_size);

/* SPHC_OK if it can be used: known camera models with the right param_count, finite parameters, fx and fy > 0,
 * sizes within 16 to 8192 pixels (sphc_camera_check), unit quaternion (within 1e-3), translation within 100 m,
 * depth unit within 1e-6 to 0.1 m: the limits of sphc_config. Errors: ARGUMENT, STRUCT_SIZE. [pure] */
sphc_status sphc_calibration_check(const sphc_calibration *calibration, sphc_message *message);

/* Reads a calibration file.  Set calibration->struct_size first (sphc_calibration_init does).
 * Errors, all with file, key, cause and cure in the message: DEVICE (cannot be read), ARGUMENT (contents),
 * STRUCT_SIZE. [pure] */
sphc_status sphc_calibration_read(const char *path, sphc_calibration *calibration, sphc_message *message);

/* The same from `bytes` of text that is not a file; `name` stands for the file in messages. [pure] */
sphc_status sphc_calibration_parse(const char *text, size_t bytes, const char *name, sphc_calibration *calibration,
                                   sphc_message *message);

/* Writes a calibration file, replacing one that is there.  Reading it back gives the same bits.
 * Errors: ARGUMENT, STRUCT_SIZE, DEVICE (cannot be written). [pure] */
sphc_status sphc_calibration_write(const char *path, const sphc_calibration *calibration, sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_HOST_RECORDING_CALIBRATION_H */
