/* plugin.h - what the driver asks of libcamera: the table that its plug-in gives, and a fake in the tests.
 *
 * Only C and our own types pass, so that driver and plug-in may come from different compilers.  One thread at a
 * time per camera.  Nothing throws, and nothing but wait blocks longer than the kernel takes.
 */
#ifndef SPHERECLOUD_DRIVERS_LIBCAMERA_PLUGIN_H
#define SPHERECLOUD_DRIVERS_LIBCAMERA_PLUGIN_H

#include "libcamera.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SPHC_LIBCAMERA_PLUGIN_VERSION 1u
#define SPHC_LIBCAMERA_PLUGIN_ENTRY "sphc_libcamera_plugin_entry"
#define SPHC_LIBCAMERA_BUFFERS_MAX 32u

typedef struct sphc_libcamera_device sphc_libcamera_device; /* an acquired camera */

typedef struct sphc_libcamera_mode {
  uint32_t fourcc; /* of DRM, as libcamera has it */
  uint32_t width, height, stride_bytes;
  uint32_t buffers;    /* at most SPHC_LIBCAMERA_BUFFERS_MAX */
  uint32_t full_range; /* 1: of YUV all values are used, as JPEG does */
} sphc_libcamera_mode;

typedef struct sphc_libcamera_buffer {
  const uint8_t *data[2]; /* planes; the second one null when there is none */
  uint64_t bytes[2];      /* that are mapped */
} sphc_libcamera_buffer;

typedef struct sphc_libcamera_frame {
  uint32_t buffer;   /* its index; not written to until it is queued again */
  uint32_t sequence; /* the kernel's */
  uint32_t damaged;  /* 1: the camera or the bus said so */
  uint32_t reserved;
  uint64_t used_bytes[2];
  int64_t sensor_time_ns; /* SensorTimestamp, else the buffer's own time; 0: neither */
  int64_t exposure_us;    /* 0: not told */
} sphc_libcamera_frame;

typedef struct sphc_libcamera_range {
  int64_t min, max; /* of booleans 0 and 1 */
} sphc_libcamera_range;

typedef struct sphc_libcamera_plugin {
  uint32_t version;
  const char *library; /* "0.0.3" */
  sphc_status (*list)(sphc_libcamera_name *names, uint32_t capacity, uint32_t *count, sphc_message *message);
  /* `id` null: the first. */
  sphc_status (*open)(const char *id, sphc_libcamera_device **device, sphc_libcamera_name *name,
                      sphc_message *message);
  void (*close)(sphc_libcamera_device *device); /* stops it, too; the buffers are gone */
  /* Up to `capacity`; gives how many there are. */
  uint32_t (*formats)(sphc_libcamera_device *device, uint32_t *fourccs, uint32_t capacity);
  /* In: what is wanted, size 0 for the camera's choice.  Out: what libcamera made of it. */
  sphc_status (*configure)(sphc_libcamera_device *device, sphc_libcamera_mode *mode, sphc_message *message);
  sphc_status (*buffer)(const sphc_libcamera_device *device, uint32_t index, sphc_libcamera_buffer *buffer);
  /* Controls go by libcamera's own names; these differ less from release to release than its symbols do.
   * UNSUPPORTED: the camera has no such control.  What is set counts from the next start. */
  sphc_status (*control)(const sphc_libcamera_device *device, const char *name, sphc_libcamera_range *range);
  sphc_status (*set)(sphc_libcamera_device *device, const char *name, int64_t value);
  /* Begins, with all buffers queued. */
  sphc_status (*start)(sphc_libcamera_device *device, sphc_message *message);
  /* OK: a frame.  AGAIN: none in time.  E_DEVICE_LOST.  E_DEVICE: a buffer could not be queued. */
  sphc_status (*wait)(sphc_libcamera_device *device, uint32_t timeout_us, sphc_libcamera_frame *frame,
                      sphc_message *message);
  void (*queue)(sphc_libcamera_device *device, uint32_t buffer);
  void (*stop)(sphc_libcamera_device *device);
} sphc_libcamera_plugin;

/* The one symbol of the plug-in.  Null when it does not speak `version`. */
typedef const sphc_libcamera_plugin *(*sphc_libcamera_plugin_fn)(uint32_t version);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_LIBCAMERA_PLUGIN_H */
