/* recording_writer.h - writes recordings of one file an image, which replay.h reads: the TUM layout with a
 * calibration file, and frames of the 7-Scenes layout.  To record live, see recorder.h.
 *
 *     FOLDER/calibration.json
 *     FOLDER/rgb.txt, rgb/000000.png, ...      "seconds.nanoseconds rgb/000000.png" a line
 *     FOLDER/depth.txt, depth/000000.png, ...
 *     FOLDER/groundtruth.txt                   "time tx ty tz qx qy qz qw" a line, world_from_camera
 *
 * An image is complete on disk before its list names it, and every line is handed to the operating system at once:
 * a recording cut short by a crash of the program can be read up to there.
 *
 * Conventions are those of spherecloud.h.  These functions allocate and write files; no C++ exception leaves them.
 */
#ifndef SPHERECLOUD_DRIVERS_REPLAY_RECORDING_WRITER_H
#define SPHERECLOUD_DRIVERS_REPLAY_RECORDING_WRITER_H

#include <spherecloud/spherecloud.h>

#include "calibration.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_recording_writer sphc_recording_writer;

/* Starts a recording in `folder`, which is made if need be (its parent must be there).  `calibration` is copied and
 * written.  Errors: ARGUMENT (null, calibration), STRUCT_SIZE, STATE (the folder holds a recording already; nothing
 * is overwritten), DEVICE (cannot be written). [pure] */
sphc_status sphc_recording_create(const char *folder, const sphc_calibration *calibration,
                                  sphc_recording_writer **writer, sphc_message *message);

/* Appends an image: stream, time_ns and image of *capture; the rest is ignored.  Borrows.  Lossless PNG of fast
 * compression.  Times of a stream must increase and not be negative.  The image's size must be the calibration's.
 * Errors:
 * ARGUMENT (null, time, stream), STRUCT_SIZE, IMAGE: nothing is added, go on; DEVICE (disk full): what was added
 * stays readable, but every later call is SPHC_E_STATE. [exclusive] */
sphc_status sphc_recording_add(sphc_recording_writer *writer, const sphc_capture *capture, sphc_message *message);

/* Both images of a frame: sphc_recording_add of colour, then of depth. [exclusive] */
sphc_status sphc_recording_add_frame(sphc_recording_writer *writer, const sphc_frame *frame, sphc_message *message);

/* Appends a pose of the colour camera.  Times must increase and not be negative; they need not be those of images.
 * Errors: ARGUMENT (null, time, not finite, quaternion not of unit length), DEVICE. [exclusive] */
sphc_status sphc_recording_add_pose(sphc_recording_writer *writer, int64_t time_ns,
                                    const sphc_rigid *world_from_camera, sphc_message *message);

/* Ends the recording and frees the writer.  Accepts null and pointer to null; sets *writer to null. [exclusive] */
void sphc_recording_close(sphc_recording_writer **writer);

/* Writes one frame of the 7-Scenes layout into `folder`, which is there: frame-NNNNNN.color.png, .depth.png and,
 * unless `world_from_camera` (of the colour camera) is null, .pose.txt; NNNNNN is frame->sequence.  The layout
 * keeps neither times nor a calibration.  Errors: ARGUMENT, STRUCT_SIZE, IMAGE, STATE (the frame is there already),
 * DEVICE. [pure] */
sphc_status sphc_recording_write_7scenes(const char *folder, const sphc_frame *frame,
                                         const sphc_rigid *world_from_camera, sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_REPLAY_RECORDING_WRITER_H */
