/* raw.h - reads a raw recording on a device: no OpenCV, no decompression, no allocation, C99.
 *
 *     spherecloud convert walk.mcap walk.raw --to raw      on the workstation
 *
 *     sphc_raw_open(&raw, read_file, file, file_bytes, &message);
 *     for (i = 0; i < raw.frame_count; ++i) {
 *       sphc_raw_read_frame(&raw, i, memory, sizeof memory, &recorded, &message);   raw.frame_bytes of memory
 *       sphc_localizer_process(localizer, &recorded.frame, &result);
 *     }
 *
 * The bytes come from wherever the caller has them: a file, flash, a wire.  docs/recording.md has the format.  All
 * of it is checked (sizes, cameras, checksums) before it is believed.  Conventions are those of spherecloud.h.
 */
#ifndef SPHERECLOUD_DRIVERS_RAW_RAW_H
#define SPHERECLOUD_DRIVERS_RAW_RAW_H

#include <spherecloud/spherecloud.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Copies exactly `bytes` bytes from `offset` of the recording to `out`; 0 when it did. */
typedef int (*sphc_raw_read)(void *user, uint64_t offset, void *out, size_t bytes);

/* What the recording holds.  Made by sphc_raw_open; read it, do not change it. */
typedef struct sphc_raw {
  sphc_raw_read read;
  void *user;
  uint32_t frame_count;
  sphc_format color_format; /* of all colour images; rows without padding */
  sphc_rig rig;
  size_t frame_bytes; /* of memory that sphc_raw_read_frame needs */
} sphc_raw;

typedef struct sphc_raw_frame {
  sphc_localizer_frame frame;   /* its images lie in the memory that was given */
  uint32_t has_pose;            /* 1: world_from_camera is known */
  sphc_rigid world_from_camera; /* of the colour camera, at the colour time; the world is the recording's own */
} sphc_raw_frame;

/* Reads and checks the header.  `file_bytes` is the length of the whole recording.  `message` may be null.
 * Errors: ARGUMENT (null, or no raw recording of this version, changed, cut), DEVICE (`read` failed). [pure] */
sphc_status sphc_raw_open(sphc_raw *raw, sphc_raw_read read, void *user, uint64_t file_bytes,
                          sphc_message *message);

/* Reads frame `index` into `memory` (2-byte aligned, at least raw->frame_bytes, borrowed by *recorded) and checks
 * it. Errors: ARGUMENT (null, index, memory), DEVICE (`read` failed, or the bytes have changed): another frame can
 * be read. [exclusive] of memory and of what `read` does. */
sphc_status sphc_raw_read_frame(const sphc_raw *raw, uint32_t index, void *memory, size_t memory_bytes,
                                sphc_raw_frame *recorded, sphc_message *message);
/* Times, number and pose alone, without images: frame.color.data and frame.depth.data are null.  Errors: as above,
 * but for memory. [exclusive] of what `read` does. */
sphc_status sphc_raw_read_head(const sphc_raw *raw, uint32_t index, sphc_raw_frame *recorded,
                               sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_RAW_RAW_H */
