/* recording_writer.h - writes recordings of one file an image, which replay.h reads: the TUM layout with a
 * calibration file.  To record live, see recorder.h.
 *
 *     FOLDER/calibration.json
 *     FOLDER/rgb.txt, rgb/000000.png, ...      "seconds.nanoseconds rgb/000000.png" a line
 *     FOLDER/depth.txt, depth/000000.png, ...
 *     FOLDER/groundtruth.txt                   "time tx ty tz qx qy qz qw" a line, world_from_camera
 *
 * Until sphc_recording_close a file unfinished.txt stands in the folder, and readers refuse it: half a recording is
 * never taken for a whole one.  An image is complete before its list names it, and every line is handed to the
 * operating system at once: after a crash, removing unfinished.txt makes what is there readable.
 *
 * Conventions are those of spherecloud.h.  These functions allocate and write files; no C++ exception leaves them.
 */
#ifndef SPHERECLOUD_HOST_RECORDING_RECORDING_WRITER_H
#define SPHERECLOUD_HOST_RECORDING_RECORDING_WRITER_H

#include <spherecloud/spherecloud_capture.h>

#include "calibration.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_recording_writer sphc_recording_writer;

/* Starts a recording in `folder`, which is made if need be (its parent must be there).  `rig` is copied and
 * written. Errors: ARGUMENT (null, sphc_rig_check), STATE (the folder holds a recording already; nothing is
 * overwritten), DEVICE (cannot be written). [pure] */
sphc_status sphc_recording_create(const char *folder, const sphc_rig *rig, sphc_recording_writer **writer,
                                  sphc_message *message);

/* Appends an image: stream, time_ns and image of *capture; the rest is ignored.  Borrows.  Lossless PNG of fast
 * compression.  Times of a stream must increase and not be negative.  The image's size must be the calibration's.
 * Errors:
 * ARGUMENT (null, time, stream), STRUCT_SIZE, IMAGE: nothing is added, go on; DEVICE (disk full): every later call
 * is SPHC_E_STATE, and the recording stays unfinished. [exclusive] */
sphc_status sphc_recording_add(sphc_recording_writer *writer, const sphc_capture *capture, sphc_message *message);

/* Both images of a frame: sphc_recording_add of colour, then of depth. [exclusive] */
sphc_status sphc_recording_add_frame(sphc_recording_writer *writer, const sphc_localizer_frame *frame,
                                     sphc_message *message);

/* Appends a pose of the colour camera.  Times must increase and not be negative; they need not be those of images.
 * Errors: ARGUMENT (null, time, not finite, quaternion not of unit length), DEVICE. [exclusive] */
sphc_status sphc_recording_add_pose(sphc_recording_writer *writer, int64_t time_ns,
                                    const sphc_rigid *world_from_camera, sphc_message *message);

/* Finishes the recording and frees the writer, also on an error.  Accepts null and pointer to null; sets *writer to
 * null.  Errors: STATE (an earlier write failed; the recording stays unfinished), DEVICE. [exclusive] */
sphc_status sphc_recording_close(sphc_recording_writer **writer, sphc_message *message);

/* Frees the writer and leaves the recording unfinished, as a crash would.  Accepts null and pointer to null; sets
 * *writer to null. [exclusive] */
void sphc_recording_abandon(sphc_recording_writer **writer);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_HOST_RECORDING_RECORDING_WRITER_H */
