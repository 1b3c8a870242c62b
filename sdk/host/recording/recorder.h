/* recorder.h - records captures into one file that survives a crash, and that replay.h plays.
 *
 *     sphc_recorder_open("walk.mcap", &calibration, NULL, &recorder, &message);
 *     while ((status = source.acquire(source.self, timeout_us, &capture)) >= 0 && status != SPHC_END) {
 *       if (status == SPHC_AGAIN) continue;    nothing came in time
 *       sphc_recorder_add(recorder, &capture, &message);
 *       source.release(source.self, &capture);
 *     }
 *     sphc_recorder_close(&recorder, &message);
 *
 * The file is MCAP with ROS 2's messages (docs/recording.md), which Foxglove and ROS tools read.  Depth is kept to
 * the bit; colour too, unless JPEG is asked for.  All of a capture is kept: sequence, times, clock, exposure.
 *
 * Crash.  Captures are gathered into chunks, each written whole and with a checksum.  A recording that was cut off,
 * by kill -9 or a power cut, plays up to its last whole chunk.  At most so much is lost: what is in the queue, the
 * chunk being filled, and in a power cut what came since the last sync (config.sync_ms for both of these).
 *
 * Loss.  sphc_recorder_add copies and returns; one thread of the recorder's own encodes and writes.  When the disk
 * cannot follow and the queue is full, a capture is dropped, counted, and listed in the file, as are gaps in the
 * sequence of a stream, which are losses before the recorder (but see config.gaps_are_losses).
 *
 * Memory.  All of it is made at open: queue_slots images, a chunk, and room to encode.  zstd and the JPEG encoder
 * make theirs at their first image.
 *
 * Conventions are those of spherecloud.h.  No C++ exception leaves these functions.
 */
#ifndef SPHERECLOUD_HOST_RECORDING_RECORDER_H
#define SPHERECLOUD_HOST_RECORDING_RECORDER_H

#include <spherecloud/spherecloud_capture.h>

#include "calibration.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_recorder sphc_recorder;

/* How depth is stored; all without loss. */
typedef int32_t sphc_depth_codec;
enum {
  SPHC_DEPTH_RAW = 1, /* as it is: every tool reads it */
  SPHC_DEPTH_RVL = 2, /* as ROS's compressedDepth: about a quarter of it */
  SPHC_DEPTH_ZSTD = 3 /* our own: about an eighth, at a similar cost */
};

typedef struct sphc_recorder_config {
  uint32_t struct_size;
  sphc_depth_codec depth_codec; /* ZSTD */
  uint32_t jpeg_quality;        /* of colour, 1 to 100; 0: raw, to the bit; 0 */
  uint32_t queue_slots;         /* captures waiting for the writer; 2 to 1024; 16 */
  uint32_t wait_us;             /* how long add waits for a free slot before it drops; 0 */
  uint32_t sync_ms;             /* what is older is on the disk, the queue aside; 10 to 60000; 1000 */
  uint32_t chunk_bytes;         /* a chunk is written once it is so full; 65536 to 2^28; 4 MiB */
  uint32_t gaps_are_losses;     /* 0: numbers that a stream skips are of files that nobody wrote; 1 */
} sphc_recorder_config;

/* The defaults stand behind the fields above.  Errors: ARGUMENT, STRUCT_SIZE. [pure] */
sphc_status sphc_recorder_config_init(sphc_recorder_config *config, size_t struct_size);

/* Starts a recording in the new file `path` and a thread.  `config` null: the defaults; it is copied, and so is the
 * rig, which is written.  Errors: ARGUMENT (null, config, sphc_rig_check), STRUCT_SIZE, STATE (the file is
 * there already; nothing is overwritten), DEVICE (cannot be written). [pure] */
sphc_status sphc_recorder_open(const char *path, const sphc_rig *rig, const sphc_recorder_config *config,
                               sphc_recorder **recorder, sphc_message *message);

/* Adds a capture.  Borrows.  Amplitudes of a depth capture are kept as numbers of 16 bits.  The size of images must
 * be the calibration's; times of a stream must increase and not be negative.  SPHC_AGAIN: the queue stayed full for
 * wait_us; the capture is dropped, counted and listed in the file.  Errors: ARGUMENT (null, time, stream),
 * STRUCT_SIZE, IMAGE: nothing is added, go on; DEVICE: the file cannot be written any more (disk full); close, what
 * was written before is good. [exclusive] */
sphc_status sphc_recorder_add(sphc_recorder *recorder, const sphc_capture *capture, sphc_message *message);

/* Adds a pose of the colour camera, of a time after the last pose's and not negative.  SPHC_AGAIN and errors
 * as above. [exclusive] */
sphc_status sphc_recorder_add_pose(sphc_recorder *recorder, int64_t time_ns, const sphc_rigid *world_from_camera,
                                   sphc_message *message);

/* Adds what an accelerometer felt, in the axes of the colour camera: at rest 9.81 upwards (a sensor's own axes are
 * turned by its calibration).  `spherecloud map` finds the vertical by it.  Times must increase and not be
 * negative. It waits for the next capture or pose, and takes no slot of its own until 256 wait; after a crash those
 * that wait are lost.  SPHC_AGAIN: these found no slot; this one is dropped and counted.  Errors as above;
 * ARGUMENT: zero or not finite too. [exclusive] */
sphc_status sphc_recorder_add_acceleration(sphc_recorder *recorder, int64_t time_ns, const double felt_mps2[3],
                                           sphc_message *message);

typedef struct sphc_recorder_statistics {
  uint32_t struct_size;
  uint32_t queue_most;  /* slots that were in use at once */
  uint64_t color_count; /* captures written */
  uint64_t depth_count;
  uint64_t dropped_count; /* captures, poses and accelerations that found the queue full, or the disk failing */
  uint64_t missing_count; /* gaps in the sequences of the streams */
  uint64_t raw_bytes;     /* of the images written, before encoding */
  uint64_t file_bytes;    /* so far */
} sphc_recorder_statistics;
/* Set statistics->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [shared] */
sphc_status sphc_recorder_get_statistics(const sphc_recorder *recorder, sphc_recorder_statistics *statistics);

/* Writes what waits, the file's index and its end, brings it to the disk, and frees the recorder in any case.
 * Accepts null and pointer to null; sets *recorder to null.  DEVICE: the file could not be written to its end; what
 * was written before is good. [exclusive] */
sphc_status sphc_recorder_close(sphc_recorder **recorder, sphc_message *message);

/* Writes what waits and frees the recorder, but gives the file no end: it counts as cut, as after a crash.  Accepts
 * null and pointer to null; sets *recorder to null. [exclusive] */
void sphc_recorder_abandon(sphc_recorder **recorder);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_HOST_RECORDING_RECORDER_H */
