/* calibration.h - the file of a rig's calibration (docs/drivers.md has the format).
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

/* Reads a calibration file.  A file says sphc_rig's fields, with pixel centres at 0.5 (as everywhere) or at 0; what
 * is read passes sphc_rig_check.  Errors, all with file, key, cause and cure in the message: DEVICE (cannot be
 * read), ARGUMENT (contents). [pure] */
sphc_status sphc_calibration_read(const char *path, sphc_rig *rig, sphc_message *message);

/* The same from `bytes` of text that is not a file; `name` stands for the file in messages. [pure] */
sphc_status sphc_calibration_parse(const char *text, size_t bytes, const char *name, sphc_rig *rig,
                                   sphc_message *message);

/* Writes a calibration file, replacing one that is there.  Reading it back gives the same bits.
 * Errors: ARGUMENT (sphc_rig_check), DEVICE (cannot be written). [pure] */
sphc_status sphc_calibration_write(const char *path, const sphc_rig *rig, sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_HOST_RECORDING_CALIBRATION_H */
