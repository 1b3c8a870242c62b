/* v4l2.h - a camera of Linux (Video4Linux2) as a source: one node (/dev/videoN), one stream.
 *
 *     sphc_v4l2_config config;
 *     sphc_v4l2_config_init(&config, sizeof config);
 *     config.stream = SPHC_STREAM_DEPTH;
 *     sphc_v4l2_open("/dev/video2", &config, &camera, &message);
 *     sphc_v4l2_source(camera, &source);               start, acquire, release, stop (spherecloud_capture.h)
 *     sphc_v4l2_close(&camera);
 *
 * Colour comes as YUYV, UYVY, NV12, GREY, RGB3, BGR3, XR24 or MJPG and leaves as GRAY8, RGB8 or BGR8; depth comes
 * as Z16 or Y16 and leaves as DEPTH16.  A headset's two cameras are two nodes, two handles and one pairer.
 *
 * What is not delivered is counted (sphc_v4l2_stats) and shows as a gap in capture.sequence.  docs/drivers_v4l2.md
 * says what each fault of a device leads to, and what is known of the times.
 *
 * Conventions (frames, units, failure, thread classes) are those of spherecloud.h.  All memory is taken by
 * sphc_v4l2_open; no function after it allocates, but for what libjpeg-turbo itself takes while it decodes a frame
 * of MJPG.  Every wait has a timeout.  No C++ exception leaves these functions.  The library starts no thread.
 */
#ifndef SPHERECLOUD_DRIVERS_V4L2_V4L2_H
#define SPHERECLOUD_DRIVERS_V4L2_V4L2_H

#include <spherecloud/spherecloud_capture.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_v4l2 sphc_v4l2;

/* Four characters as Linux writes pixel layouts: SPHC_V4L2_FOURCC('Y', 'U', 'Y', 'V'). */
#define SPHC_V4L2_FOURCC(a, b, c, d) \
  ((uint32_t)(a) | ((uint32_t)(b) << 8) | ((uint32_t)(c) << 16) | ((uint32_t)(d) << 24))

/* ---- config ------------------------------------------------------------------------------------------------- */

#define SPHC_V4L2_MAX_BUFFERS 32u
#define SPHC_V4L2_MAX_FOURCCS 8u

typedef struct sphc_v4l2_config {
  uint32_t struct_size;
  sphc_stream stream;     /* COLOR; or DEPTH */
  sphc_format format;     /* of the captures: GRAY8, RGB8, BGR8; DEPTH16.  0: GRAY8 of colour, DEPTH16 of depth */
  uint32_t width, height; /* 640 x 480 */
  uint32_t fps;           /* 30; 0: whatever the device does */
  uint32_t fourccs[SPHC_V4L2_MAX_FOURCCS]; /* layouts to try, the best one first; all 0: all that we know and the
                                              device has, the cheapest to convert first */
  uint32_t buffers;                        /* the kernel's; 3 to SPHC_V4L2_MAX_BUFFERS; 6 */
  uint32_t loan_limit;                     /* of the source; 2 to buffers - 1; 3, too few for the 4 slots that a
                                              pairer has by default: it needs one more than slots */
  uint32_t
      allow_adjusting;    /* 0; 1: take what the device makes of the wish (sphc_v4l2_mode.adjusted), not an error */
  uint32_t export_dmabuf; /* 0; 1: buffers are dma-bufs (sphc_v4l2_dmabuf) */
  uint32_t always_copy;   /* 0; 1: depth and GREY are copied, not lent in the kernel's buffers; for boards whose
                             buffers are slow to read */
} sphc_v4l2_config;

/* The defaults stand behind the fields above.  Errors: ARGUMENT, STRUCT_SIZE. [pure] */
sphc_status sphc_v4l2_config_init(sphc_v4l2_config *config, size_t struct_size);

/* ---- what is there ------------------------------------------------------------------------------------------ */

typedef struct sphc_v4l2_device {
  char node[32];   /* "/dev/video2" */
  char card[32];   /* the camera's name */
  char bus[32];    /* the plug it is in; stays the same through replugging */
  char driver[16]; /* of the kernel */
  uint32_t fourcc_count;
  uint32_t fourccs[32];          /* the first layouts it offers, known to us or not */
  uint32_t can_color, can_depth; /* 1: among all it offers is one for this stream */
  char problem[96];              /* why it cannot be opened; empty when it can */
} sphc_v4l2_device;

/* Fills up to `capacity` devices that capture video, in order of their numbers, and sets *count to how many there
 * are; nodes of metadata, radio, output and codecs are skipped.  A node that cannot be opened is listed with its
 * problem.  Errors: ARGUMENT. [pure] */
sphc_status sphc_v4l2_list(sphc_v4l2_device *devices, uint32_t capacity, uint32_t *count);

/* ---- open, close -------------------------------------------------------------------------------------------- */

/* Opens a camera, agrees on a mode with it and makes the buffers.  `camera` is a path ("/dev/video2", a link in
 * /dev/v4l/by-id), or "card=NAME" or "bus=PLUG" as sphc_v4l2_list names them: the first such node that has the
 * stream.  Node numbers change when a camera is plugged in again; its card and bus do not.
 * `config` null: the defaults; it is copied.
 * Errors: ARGUMENT, STRUCT_SIZE, DEVICE (not there, no permission, in use, out of memory), DEVICE_LOST (unplugged
 * meanwhile), UNSUPPORTED (no such layout, size or rate: the message says what was asked and what came). [pure] */
sphc_status sphc_v4l2_open(const char *camera, const sphc_v4l2_config *config, sphc_v4l2 **v4l2,
                           sphc_message *message);
/* Ends every loan.  Accepts null and pointer to null; sets *v4l2 to null. [exclusive] */
void sphc_v4l2_close(sphc_v4l2 **v4l2);

/* Fills *source (struct_size too) with the contract of spherecloud_capture.h; valid until sphc_v4l2_close.
 * start: E_DEVICE (such as too little USB bandwidth).  acquire: SPHC_AGAIN when no good frame came within the
 * timeout: the message says so, and why the last bad one was left out; E_DEVICE: the next acquire goes on, or the
 * kernel has given the stream up, and the message says to stop and start; E_DEVICE_LOST: unplugged, or the signal
 * changed its size: stop, close, open again, by bus or card where it was unplugged.  Errors: ARGUMENT. [exclusive]
 */
sphc_status sphc_v4l2_source(sphc_v4l2 *v4l2, sphc_source *source);

/* ---- what was agreed on, and what happened ------------------------------------------------------------------ */

/* Bits of sphc_v4l2_mode.adjusted: what differs from the config. */
enum { SPHC_V4L2_ADJUSTED_FOURCC = 1u, SPHC_V4L2_ADJUSTED_SIZE = 2u, SPHC_V4L2_ADJUSTED_FPS = 4u };

typedef struct sphc_v4l2_mode {
  uint32_t struct_size;
  uint32_t fourcc;
  uint32_t width, height;
  uint32_t stride_bytes;                         /* of the device's image; 0 of MJPG */
  uint32_t period_numerator, period_denominator; /* seconds from a frame to the next; 0 / 0: not told */
  uint32_t adjusted;
  uint32_t buffers;   /* that the kernel gave */
  uint32_t zero_copy; /* 1: captures are the kernel's buffers */
  char node[32], card[32], bus[32], driver[16];
} sphc_v4l2_mode;
/* Set mode->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [shared] */
sphc_status sphc_v4l2_get_mode(const sphc_v4l2 *v4l2, sphc_v4l2_mode *mode);

typedef struct sphc_v4l2_stats {
  uint32_t struct_size;
  uint32_t reserved;
  /* Frames since opening. */
  uint64_t captured;     /* handed out */
  uint64_t lost;         /* missing in the device's own count */
  uint64_t corrupt;      /* marked so by the kernel, or not a whole JPEG */
  uint64_t short_frames; /* of fewer bytes than the mode's */
  uint64_t duplicated;   /* same number and time as the one before; left out */
  uint64_t uncounted;    /* the device's count stood still or jumped: taken as the next one */
  uint64_t
      time_replaced; /* time impossible (before start, in the future, not later than the last): arrival instead */
  uint64_t time_refused; /* left out: not later than the last time, which was another frame's arrival */
  /* Others. */
  uint64_t starved;         /* the caller was slow: every buffer was full, so the device could only lose frames */
  uint64_t device_errors;   /* acquire said E_DEVICE */
  uint64_t control_changes; /* of exposure, by anyone */
} sphc_v4l2_stats;
/* Set stats->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [exclusive] */
sphc_status sphc_v4l2_get_stats(const sphc_v4l2 *v4l2, sphc_v4l2_stats *stats);

/* The dma-buf that holds a capture on loan, for another device to read; owned by the handle, valid as long as the
 * loan.  Errors: ARGUMENT (null, or not on loan), UNSUPPORTED (config.export_dmabuf is 0, or the capture was
 * converted). [exclusive] */
sphc_status sphc_v4l2_dmabuf(sphc_v4l2 *v4l2, const sphc_capture *capture, int32_t *fd);

/* ---- controls ----------------------------------------------------------------------------------------------- */

typedef struct sphc_v4l2_control {
  uint32_t id;   /* V4L2_CID_...; names vary from kernel to kernel, ids do not */
  char name[36]; /* "Exposure Time, Absolute" */
  int64_t minimum, maximum, step, default_value;
  uint32_t is_read_only;
  uint32_t is_inactive; /* 1: another control, such as automatic exposure, overrules it now */
} sphc_v4l2_control;

/* Controls with a value that is a number, a switch or a choice; as sphc_v4l2_list.
 * Errors: ARGUMENT, DEVICE, DEVICE_LOST. [exclusive] */
sphc_status sphc_v4l2_list_controls(sphc_v4l2 *v4l2, sphc_v4l2_control *controls, uint32_t capacity,
                                    uint32_t *count, sphc_message *message);
/* By name, whatever its case and punctuation: "exposure_time_absolute" finds "Exposure Time, Absolute".
 * Errors: ARGUMENT, UNSUPPORTED (no such control), DEVICE, DEVICE_LOST. [exclusive] */
sphc_status sphc_v4l2_find_control(sphc_v4l2 *v4l2, const char *name, sphc_v4l2_control *control,
                                   sphc_message *message);
/* Errors: ARGUMENT, UNSUPPORTED (no such control, or one that can only be set), DEVICE, DEVICE_LOST. [exclusive] */
sphc_status sphc_v4l2_get_control(sphc_v4l2 *v4l2, uint32_t id, int64_t *value, sphc_message *message);
/* Errors: as above; ARGUMENT: out of range or between two steps (the kernel would bend it silently), or none of a
 * menu's choices; UNSUPPORTED: read only; STATE: inactive. [exclusive] */
sphc_status sphc_v4l2_set_control(sphc_v4l2 *v4l2, uint32_t id, int64_t value, sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_V4L2_V4L2_H */
