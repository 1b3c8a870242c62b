/* raw_writer.h - writes a raw recording on a device: no OpenCV, no compression, no allocation, C99.
 *
 *     sphc_raw_writer_begin(&writer, write_bytes, file, &rig, SPHC_FORMAT_GRAY8, &message);
 *     while (walks) sphc_raw_writer_add(&writer, &frame, NULL, &message);
 *     sphc_raw_writer_finish(&writer, &message);
 *
 *     spherecloud map walk.raw --model walk.model          on the workstation, to which the file was copied
 *
 * The bytes go to wherever the caller wants them: a file, flash, a wire.  docs/recording.md has the format; raw.h
 * reads it.  A writer is the caller's and may be forgotten at any time.  Conventions are those of spherecloud.h.
 */
#ifndef SPHERECLOUD_DRIVERS_RAW_RAW_WRITER_H
#define SPHERECLOUD_DRIVERS_RAW_RAW_WRITER_H

#include <spherecloud/spherecloud.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Puts `count` bytes, at most a row of the colour image or 512, at `offset` of the recording; 0 when it did.
 * Offsets go up without a gap, but for those of the header, which begin at 0, and those of a frame that is written
 * again. */
typedef int (*sphc_raw_write)(void *user, uint64_t offset, const void *bytes, size_t count);

/* Made by sphc_raw_writer_begin; read it, do not change it.  A copy goes on from where it was made. */
typedef struct sphc_raw_writer {
  sphc_raw_write write;
  void *user;
  sphc_rig rig;
  sphc_format color_format;
  uint32_t frame_count;                 /* that were written whole */
  size_t frame_bytes;                   /* of the recording, each frame */
  int64_t color_time_ns, depth_time_ns; /* of the last frame */
} sphc_raw_writer;

/* Writes the header of a recording without frames.  `rig` is copied; `color_format` is that of all colour images:
 * GRAY8, RGB8 or BGR8.  `message` may be null.
 * Errors: ARGUMENT (null, the rig, the format), DEVICE (`write` failed). [exclusive] of the writer */
sphc_status sphc_raw_writer_begin(sphc_raw_writer *writer, sphc_raw_write write, void *user, const sphc_rig *rig,
                                  sphc_format color_format, sphc_message *message);

/* Writes a frame: sequence, times, colour and depth (DEPTH16, in the rig's units) of `frame`, which are borrowed
 * and are read twice, so they must not change; rows may be padded.  `world_from_camera` is the pose of the colour
 * camera at color_time_ns, in a world of the caller's own, or null where it is not known. Errors: ARGUMENT (null,
 * the pose, a time below 0, of colour one that does not grow, of depth one that goes back), STRUCT_SIZE (of the
 * frame), IMAGE (an image does not fit its camera or the format), DEVICE (`write` failed), STATE (4294967295 frames
 * are written): nothing is counted, and the next frame takes its place. [exclusive] of the writer */
sphc_status sphc_raw_writer_add(sphc_raw_writer *writer, const sphc_localizer_frame *frame,
                                const sphc_rigid *world_from_camera, sphc_message *message);

/* Writes the header again, which now counts the frames.  More may be added, and counted by the next call.
 * Errors: ARGUMENT (null), DEVICE (`write` failed). [exclusive] of the writer */
sphc_status sphc_raw_writer_finish(sphc_raw_writer *writer, sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_RAW_RAW_WRITER_H */
