/* openni2.h - colour and depth from one camera that OpenNI2 knows, or from an .oni recording, as one source.
 *
 *     sphc_openni2_config config;
 *     sphc_openni2_config_init(&config, sizeof config);
 *     sphc_openni2_open(NULL, &config, &camera, &message);     NULL: the first device; or a uri, or an .oni file
 *     sphc_openni2_source(camera, &source);                    both streams in order of time
 *     sphc_openni2_close(&camera);
 *
 * Conventions (frames, units, pixels, failure, thread classes) are those of spherecloud.h.  Opening allocates,
 * once: from start on only OpenNI2 itself does.  Every frame is checked and copied into a buffer of ours; the
 * library's own hold one frame a stream and grow when frames are kept.  The copying is done by one thread, which
 * the first opening starts and which lives as long as the process.  docs/drivers_openni2.md says why, what else
 * OpenNI2 leaves open, and what is done about it.
 */
#ifndef SPHERECLOUD_DRIVERS_OPENNI2_OPENNI2_H
#define SPHERECLOUD_DRIVERS_OPENNI2_OPENNI2_H

#include <spherecloud/spherecloud_capture.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_openni2 sphc_openni2;

/* ---- which devices are there ---- */

#define SPHC_OPENNI2_TEXT_BYTES 256u

typedef struct sphc_openni2_device {
  char uri[SPHC_OPENNI2_TEXT_BYTES]; /* for sphc_openni2_open; for most cameras it names the USB port */
  char vendor[SPHC_OPENNI2_TEXT_BYTES];
  char name[SPHC_OPENNI2_TEXT_BYTES];
} sphc_openni2_device;

/* Copies up to `capacity` devices (`devices` may be null when it is 0) and sets *count to how many there are.
 * Errors: ARGUMENT, DEVICE (OpenNI2 cannot start; the message says what it lacks). [pure] */
sphc_status sphc_openni2_list(sphc_openni2_device *devices, uint32_t capacity, uint32_t *count,
                              sphc_message *message);

/* ---- config ---- */

/* Bits of sphc_openni2_config.streams. */
enum { SPHC_OPENNI2_STREAM_COLOR = 1u, SPHC_OPENNI2_STREAM_DEPTH = 2u };

/* What is wanted of a stream; 0: whatever the device offers, its present choice first. */
typedef struct sphc_openni2_mode {
  uint32_t width, height, frames_per_s;
} sphc_openni2_mode;

typedef struct sphc_openni2_config {
  uint32_t struct_size;
  uint32_t streams;               /* both */
  sphc_openni2_mode color, depth; /* 0; colour comes as RGB8 or else GRAY8, depth as DEPTH16 */
  uint32_t registration;          /* 1: the device draws depth as its colour camera sees it; 0 */
  uint32_t frame_sync;            /* 1: only pairs of equal frame number come; 0 */
  uint32_t loan_limit;            /* of the source: 2 to 64 buffers; those not on loan are the queue; 8 */
  uint32_t stall_us;              /* a stream that is silent so long is a failure; 1000 to 60000000; 1 s */
  uint32_t order_wait_us;         /* wait for an older capture of the other stream; to 1000000; 0: a period */
  sphc_time_point time_point;     /* what the device's timestamps are, which OpenNI2 does not say; END */
  uint32_t time_sigma_us;         /* 1 sigma of time_ns as mid-exposure; 0: half a frame period */
  uint32_t reserved;              /* 0 */
} sphc_openni2_config;

/* The defaults stand behind the fields above.  Errors: ARGUMENT, STRUCT_SIZE. [pure] */
sphc_status sphc_openni2_config_init(sphc_openni2_config *config, size_t struct_size);

/* ---- open, close ---- */

/* `uri`: of sphc_openni2_list, the path of an .oni recording, or null for the first device.  `config` null: the
 * defaults; it is copied.  Images come neither mirrored nor cropped.
 * Errors: ARGUMENT, STRUCT_SIZE, DEVICE (no such device, in use, cannot start, out of memory), UNSUPPORTED (a mode,
 * registration or synchronisation that the device does not have, or grants in words only); the message says what it
 * has.  [pure] */
sphc_status sphc_openni2_open(const char *uri, const sphc_openni2_config *config, sphc_openni2 **openni2,
                              sphc_message *message);
/* Ends every loan.  Accepts null and pointer to null; sets *openni2 to null.  Works on a device that is gone, too.
 * [exclusive] */
void sphc_openni2_close(sphc_openni2 **openni2);

/* ---- what was opened ---- */

typedef struct sphc_openni2_info {
  uint32_t struct_size;
  uint32_t is_recording; /* 1: an .oni file */
  sphc_openni2_device device;
  sphc_openni2_mode color, depth; /* as they run; zeros for a stream that was not asked for */
  sphc_format color_format;
  uint32_t registration, frame_sync; /* as the device has them */
  uint32_t reserved;
  double depth_unit_m; /* metres per unit of the depth image */
  /* Hints, to calibrate from: pinhole cameras of the fields of view that the device tells, the principal point in
   * the middle, no distortion.  param_count 0: not told.  Registered depth has the colour camera's. */
  sphc_camera color_camera, depth_camera;
  double baseline_m; /* distance of the two cameras, without its direction; 0: not told */
} sphc_openni2_info;
/* Set info->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [shared] */
sphc_status sphc_openni2_get_info(const sphc_openni2 *openni2, sphc_openni2_info *info);

/* ---- as a source ---- */

/* Fills *source (struct_size too) with the contract of spherecloud_capture.h; valid until sphc_openni2_close.  A
 * handle has one source; a second call gives the same one.
 *
 *   time_ns      the device's timestamp, on its own clock (SPHC_CLOCK_SOURCE); a jump of that clock is bridged
 *   sequence     the device's frame index: a gap is a loss, whether the device or this driver lost it
 *   start        E_UNSUPPORTED: the device refuses config.frame_sync, for which OpenNI2 does not ask it earlier
 *   acquire      E_DEVICE: a stream is silent, or the device's clock jumped.
 *                E_IMAGE: a frame that does not fit its mode was thrown away.
 *                Each is said once, and the next acquire goes on.
 *                E_DEVICE_LOST: unplugged; what had come before is given first.
 *
 * A recording starts from the beginning each time (the file is opened again, which may fail) and comes as fast as
 * it is acquired; nothing of it is thrown away for want of buffers; then SPHC_END.  Errors: ARGUMENT. [exclusive]
 */
sphc_status sphc_openni2_source(sphc_openni2 *openni2, sphc_source *source);

/* What became of the frames of one stream since the last start. */
typedef struct sphc_openni2_counts {
  uint64_t captured;   /* given to the caller */
  uint64_t lost;       /* missing in the device's frame indices: lost in the device, on the bus or in OpenNI2 */
  uint64_t overrun;    /* thrown away because no buffer was free: release earlier, or raise loan_limit */
  uint64_t late;       /* thrown away because a later one of the other stream had been given: raise order_wait_us */
  uint64_t duplicated; /* thrown away because their frame index had been there */
  uint64_t bad;        /* thrown away because they did not fit their mode */
  uint64_t clock_jumps; /* of the device's clock */
  uint64_t stalls;      /* times that the stream was silent for stall_us */
} sphc_openni2_counts;
typedef struct sphc_openni2_statistics {
  uint32_t struct_size;
  uint32_t reserved;
  sphc_openni2_counts color, depth;
} sphc_openni2_statistics;
/* Set statistics->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [shared] */
sphc_status sphc_openni2_get_statistics(const sphc_openni2 *openni2, sphc_openni2_statistics *statistics);

/* ---- controls of the colour camera ---- */

typedef int32_t sphc_openni2_control;
enum {
  SPHC_OPENNI2_AUTO_EXPOSURE = 1,      /* 0 or 1 */
  SPHC_OPENNI2_AUTO_WHITE_BALANCE = 2, /* 0 or 1 */
  SPHC_OPENNI2_EXPOSURE = 3,           /* in the device's own unit; OpenNI2 names neither unit nor range */
  SPHC_OPENNI2_GAIN = 4                /* the same */
};
/* Whether running or not.  Errors: ARGUMENT, UNSUPPORTED (not a control of this device), DEVICE (refused, or taken
 * but not kept: the value that it has instead is in the message). [exclusive] */
sphc_status sphc_openni2_set_control(sphc_openni2 *openni2, sphc_openni2_control control, int32_t value,
                                     sphc_message *message);
/* Errors: as above. [exclusive] */
sphc_status sphc_openni2_get_control(sphc_openni2 *openni2, sphc_openni2_control control, int32_t *value,
                                     sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_OPENNI2_OPENNI2_H */
