/* libcamera.h - colour and infrared cameras through libcamera (libcamera.org), as a source.
 *
 *     sphc_libcamera_list(NULL, cameras, capacity, &count, &message);
 *     sphc_libcamera_config_init(&config, sizeof config);
 *     sphc_libcamera_open(NULL, &config, &camera, &message);      the first camera
 *     sphc_libcamera_source(camera, &source);                     captures of one stream, SPHC_STREAM_COLOR
 *     sphc_libcamera_close(&camera);
 *
 * This library does not link libcamera, whose binary interface changes with every release.  It opens a plug-in,
 * libspherecloud_libcamera.so, which is built on the machine it runs on; docs/drivers_libcamera.md.
 *
 * Depth does not come this way: libcamera has no 16-bit depth format.  Open the depth node with the V4L2 driver and
 * pair the two: both give times on CLOCK_MONOTONIC.
 *
 * Conventions (units, failure, thread classes) are those of spherecloud.h.  Unlike the functions there, opening
 * allocates; from start on this code does not (libcamera itself does, and libjpeg-turbo for MJPEG).  libcamera runs
 * a thread while a camera is open.  No C++ exception leaves these functions.
 */
#ifndef SPHERECLOUD_DRIVERS_LIBCAMERA_LIBCAMERA_H
#define SPHERECLOUD_DRIVERS_LIBCAMERA_LIBCAMERA_H

#include <spherecloud/spherecloud_capture.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_libcamera sphc_libcamera;

#define SPHC_LIBCAMERA_ID_BYTES 256u
#define SPHC_LIBCAMERA_MODEL_BYTES 64u

/* ---- which cameras are there -------------------------------------------------------------------------------- */

typedef struct sphc_libcamera_name {
  char id[SPHC_LIBCAMERA_ID_BYTES];       /* the same as long as the camera stays at its port */
  char model[SPHC_LIBCAMERA_MODEL_BYTES]; /* for people; may be "" */
} sphc_libcamera_name;

/* Copies up to `capacity` names and sets *count to how many cameras there are.  `plugin_path` null: see config.
 * Errors: ARGUMENT, UNSUPPORTED (no plug-in, or another version's), DEVICE (libcamera does not start). [pure] */
sphc_status sphc_libcamera_list(const char *plugin_path, sphc_libcamera_name *names, uint32_t capacity,
                                uint32_t *count, sphc_message *message);

/* ---- config, open, close ------------------------------------------------------------------------------------ */

typedef struct sphc_libcamera_config {
  uint32_t struct_size;
  sphc_format format;     /* of the captures: BGR8; or RGB8, GRAY8 (an infrared camera's own) */
  uint32_t width, height; /* 640, 480; both 0: what the camera likes */
  uint32_t rate_hz;       /* 0: what the camera likes */
  uint32_t exposure_us;   /* 0: automatic */
  uint32_t loan_limit;    /* of the source; 2 to 64; 8 */
  uint32_t reserved;
  const char *pixel_format; /* "YUYV", "NV12", "UYVY", "MJPG", "R8", "RG24", "BG24", "XR24": DRM's names; null: the
                               first in this order that the camera has */
  const char *plugin_path;  /* null: libspherecloud_libcamera.so, where the dynamic linker looks */
} sphc_libcamera_config;

/* The defaults stand behind the fields above.  Errors: ARGUMENT, STRUCT_SIZE. [pure] */
sphc_status sphc_libcamera_config_init(sphc_libcamera_config *config, size_t struct_size);

/* Takes a camera for this process alone and sets it up.  `id` null: the first that is there.  `config` null: the
 * defaults; it is copied.  A size, rate, format or exposure that the camera would replace by another is refused.
 * Errors: ARGUMENT, STRUCT_SIZE, UNSUPPORTED (plug-in; format, size, rate or exposure, with what there is), DEVICE
 * (no such camera, or another process has it, or out of memory). [pure] */
sphc_status sphc_libcamera_open(const char *id, const sphc_libcamera_config *config, sphc_libcamera **camera,
                                sphc_message *message);
/* Ends every loan.  Accepts null and pointer to null; sets *camera to null. [exclusive] */
void sphc_libcamera_close(sphc_libcamera **camera);

/* ---- what was opened, and what happened --------------------------------------------------------------------- */

typedef struct sphc_libcamera_info {
  uint32_t struct_size;
  uint32_t width, height;
  char pixel_format[5]; /* what the camera sends */
  char library[27];     /* libcamera's version */
  sphc_libcamera_name name;
  uint32_t exposure_min_us, exposure_max_us; /* both 0: cannot be set */
  /* Since start: */
  uint64_t lost;    /* frames that the sequence numbers leave out: nobody took them in time, or the bus lost them */
  uint64_t refused; /* frames that came damaged, cut short or with a time that went back; each was a DEVICE error */
  uint64_t without_time; /* captures whose time is that of arrival, since the camera's made no sense */
} sphc_libcamera_info;
/* Set info->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [exclusive] */
sphc_status sphc_libcamera_get_info(const sphc_libcamera *camera, sphc_libcamera_info *info);

/* ---- as a source -------------------------------------------------------------------------------------------- */

/* Fills *source (struct_size too); valid until sphc_libcamera_close.  A handle has one source.
 * capture.time_ns is libcamera's SensorTimestamp, the start of the exposure, on CLOCK_MONOTONIC, moved to the
 * middle (SPHC_TIME_MIDDLE) when the exposure is known; else SPHC_TIME_START, or SPHC_TIME_ARRIVAL where the camera
 * gives no time.  acquire: E_DEVICE for a frame that came damaged, and the next acquire goes on behind it;
 * E_DEVICE_LOST when the camera was unplugged: stop, close, open again.  Errors: ARGUMENT. [exclusive] */
sphc_status sphc_libcamera_source(sphc_libcamera *camera, sphc_source *source);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_LIBCAMERA_LIBCAMERA_H */
