/* spherecloud_capture.h - cameras, pairs of captures and clocks: the part of the C interface that may still change.
 *
 * Define SPHC_UNSTABLE as 1 before it is included: programs that use it are built again for every release.
 * Conventions are those of spherecloud.h; a sphc_capture that a driver fills has the size of this header.
 */
#ifndef SPHERECLOUD_SPHERECLOUD_CAPTURE_H
#define SPHERECLOUD_SPHERECLOUD_CAPTURE_H

#if !defined(SPHC_UNSTABLE) && !defined(SPHC_BUILDING)
#error "spherecloud_capture.h may change from release to release; define SPHC_UNSTABLE to use it"
#endif

#include <spherecloud/spherecloud.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- source: the contract that a driver fills; polled, never called back ---- */

typedef int32_t sphc_stream;
enum { SPHC_STREAM_NONE = 0, SPHC_STREAM_COLOR = 1, SPHC_STREAM_DEPTH = 2 };
SPHC_API const char *sphc_stream_name(sphc_stream stream); /* [pure] */

/* Which clock a time is on.  Times of two clocks cannot be compared. */
typedef int32_t sphc_clock_id;
enum {
  SPHC_CLOCK_SOURCE = 0,    /* the source's own, such as a device's counter or a recording's; monotonic */
  SPHC_CLOCK_MONOTONIC = 1, /* the host's CLOCK_MONOTONIC */
  SPHC_CLOCK_BOOTTIME = 2   /* the host's CLOCK_BOOTTIME */
};
SPHC_API const char *sphc_clock_id_name(sphc_clock_id clock); /* [pure] */

/* What of the exposure a time is that of. */
typedef int32_t sphc_time_point;
enum {
  SPHC_TIME_MIDDLE = 0,
  SPHC_TIME_START = 1,  /* as UVC cameras; half the exposure early when that is not known */
  SPHC_TIME_END = 2,    /* as many capture bridges: of the readout too */
  SPHC_TIME_ARRIVAL = 3 /* when it reached the host: late by readout and transfer */
};
SPHC_API const char *sphc_time_point_name(sphc_time_point point); /* [pure] */

/* One image of one stream, on loan from its source until released. */
typedef struct sphc_capture {
  uint32_t struct_size;
  sphc_stream stream;
  int64_t time_ns;            /* of the point of the exposure that time_point names, on `clock`; monotonic */
  uint64_t token;             /* the source's own; hand it back unchanged */
  uint32_t sequence;          /* counts the captures of this stream, lost ones too: a gap is a loss */
  sphc_time_point time_point; /* MIDDLE, if the driver can: it moves the time by half an exposure it knows */
  sphc_image image;           /* valid until release */
  int64_t arrival_ns;         /* when the host had it, by CLOCK_MONOTONIC; 0: not told */
  uint32_t exposure_us;       /* 0: not told */
  uint32_t time_sigma_us;     /* of time_ns as the middle of the exposure, 1 sigma; 0: exact */
  sphc_clock_id clock;
  uint32_t reserved;
  /* Of a depth capture whose source has one: the amplitude or confidence of each of its pixels, as
   * sphc_localizer_frame takes it; valid until release.  Zero: there is none. */
  sphc_image amplitude;
} sphc_capture;

/* The middle of a capture's exposure, as far as it tells: time_ns moved by half of exposure_us where time_point is
 * START or END.  Saturates.  0 for null. [pure] */
SPHC_API int64_t sphc_capture_middle_ns(const sphc_capture *capture);

/* Filled by a driver; the functions take its `self`.  States: stopped (after opening) -> start -> running -> stop
 * -> stopped, any number of times.  All [exclusive] per source. */
typedef struct sphc_source {
  uint32_t struct_size;
  uint32_t loan_limit; /* captures that may be out on loan at once; acquire beyond it is SPHC_E_STATE */
  void *self;
  /* SPHC_E_STATE when running already. */
  sphc_status (*start)(void *self);
  /* Next capture in order of time; the caller sets capture->struct_size before.  SPHC_AGAIN: none within
   * timeout_us.  SPHC_END: a recording is over. SPHC_E_DEVICE_LOST: unplugged.  SPHC_E_STATE: not running, or
   * loan_limit reached.  SPHC_E_DEVICE, SPHC_E_IMAGE: trouble with one capture, and the next acquire goes on. */
  sphc_status (*acquire)(void *self, uint32_t timeout_us, sphc_capture *capture);
  /* Every acquired capture exactly once, before stop; one that is not on loan is ignored. */
  void (*release)(void *self, const sphc_capture *capture);
  /* After it no loan is valid.  Does nothing when stopped. */
  void (*stop)(void *self);
  /* Explains the last failure; owned by the source, valid until its next call; never null. */
  const char *(*message)(const void *self);
} sphc_source;

/* ---- pairer: two streams in, frames of colour and depth out; pure, no device ---- */

#define SPHC_PAIRER_SLOTS 8u /* captures of each stream it can hold */

typedef struct sphc_pairer_config {
  uint32_t struct_size;
  uint32_t slots;       /* captures of each stream held while waiting for a partner; 1 to SPHC_PAIRER_SLOTS */
  int64_t tolerance_ns; /* pair only when the mid-exposure times differ by at most this */
} sphc_pairer_config;

/* Why a capture found no partner. */
typedef int32_t sphc_pairer_drop;
enum {
  SPHC_DROP_NONE = 0,
  SPHC_DROP_TOO_FAR = 1,   /* none within the tolerance */
  SPHC_DROP_OVERTAKEN = 2, /* another one of its stream fits better */
  SPHC_DROP_FULL = 3,      /* the other stream is silent and the slots are full */
  SPHC_DROP_ENDED = 4      /* left over at sphc_pairer_flush */
};
SPHC_API const char *sphc_pairer_drop_name(sphc_pairer_drop drop); /* [pure] */

/* What a pairer has done since sphc_pairer_init. */
typedef struct sphc_pairer_counts {
  uint32_t struct_size;
  sphc_pairer_drop last_drop; /* why the last capture was dropped */
  uint64_t pairs;
  uint64_t too_far, overtaken, full, ended; /* dropped, of both streams */
  uint64_t color_lost, depth_lost;          /* never came: gaps in `sequence` */
} sphc_pairer_counts;

typedef struct sphc_pairer sphc_pairer;
/* Defaults: 4 slots, 20 ms. [pure] */
SPHC_API sphc_status sphc_pairer_config_init(sphc_pairer_config *config, size_t struct_size);
#define SPHC_PAIRER_BYTES_MAX 2048u                           /* as SPHC_MAP_BYTES_MAX */
SPHC_API sphc_status sphc_pairer_memory(sphc_memory *memory); /* [pure] */
/* `config` is copied. Errors: ARGUMENT, STRUCT_SIZE, MEMORY_SIZE, MEMORY_ALIGNMENT. [pure] */
SPHC_API sphc_status sphc_pairer_init(void *memory, size_t memory_bytes, const sphc_pairer_config *config,
                                      sphc_pairer **pairer, sphc_message *message);
SPHC_API void sphc_pairer_fini(sphc_pairer **pairer); /* [exclusive] */
/* Gives the pairer one capture (a copy; the loan goes with it).  Call sphc_pairer_pop until SPHC_AGAIN after each
 * push.  Captures are paired by sphc_capture_middle_ns.  SPHC_E_CAPACITY: its stream's slots are full; pop first
 * (drops come out there).  SPHC_E_ARGUMENT: earlier than the one before it, on another clock than the first
 * capture (sphc_clock_mapper brings times to one clock), or a stream, clock or time_point that has no name here.
 * SPHC_E_STRUCT_SIZE: of another header. [exclusive] */
SPHC_API sphc_status sphc_pairer_push(sphc_pairer *pairer, const sphc_capture *capture);
/* SPHC_OK: *color and *depth are the oldest time-matched pair, on loan to the caller, who releases both to their
 * source after use; *dropped has stream NONE.  SPHC_AGAIN with dropped->stream NONE: nothing more until the next
 * push. SPHC_AGAIN with another dropped->stream: a capture that can no longer find a partner is handed back for
 * release; call again. [exclusive] */
SPHC_API sphc_status sphc_pairer_pop(sphc_pairer *pairer, sphc_capture *color, sphc_capture *depth,
                                     sphc_capture *dropped);
/* Ends the input: every capture still held comes out of sphc_pairer_pop as a pair or a drop. [exclusive] */
SPHC_API void sphc_pairer_flush(sphc_pairer *pairer);
/* Set counts->struct_size first. [exclusive] */
SPHC_API sphc_status sphc_pairer_get_counts(const sphc_pairer *pairer, sphc_pairer_counts *counts);

/* ---- clock mapper: times of a device's clock on the host's; pure, no device ---- */

typedef struct sphc_clock_mapper_config {
  uint32_t struct_size;
  uint32_t max_drift_ppm; /* the clocks differ by no more, parts per million; 1 to 10000 */
  int64_t window_ns;      /* what lies further back is forgotten; 1 s to 1 h */
  int64_t delay_ns;       /* from a source time to its arrival, at the least: exposure, readout, ...; within 1 h */
  int64_t delay_sigma_ns; /* of delay_ns, 1 sigma; 0 to 1 h */
  int64_t jump_ns;        /* a larger step is a clock that was set, and starts anew; 1 ns to 1 h */
} sphc_clock_mapper_config;

/* host time = source time + offset, the offset growing by drift_ppm.  A drift as large as the config's
 * max_drift_ppm says that the clock drifts more, and that mapped times are off by the rest: raise it. */
typedef struct sphc_clock_mapping {
  uint32_t struct_size;
  uint32_t samples;  /* since the last start; 2^32 - 1 at most */
  uint32_t restarts; /* clocks that were set or ran backwards */
  uint32_t reserved;
  int64_t offset_ns; /* at the last sample */
  double drift_ppm;
  int64_t sigma_ns; /* of mapped times, 1 sigma: scatter of the quickest arrivals, and delay_sigma_ns */
} sphc_clock_mapping;

typedef struct sphc_clock_mapper sphc_clock_mapper;
/* Defaults: 200 ppm, 20 s, delay 0 +- 1 ms, jump 50 ms. [pure] */
SPHC_API sphc_status sphc_clock_mapper_config_init(sphc_clock_mapper_config *config, size_t struct_size);
#define SPHC_CLOCK_MAPPER_BYTES_MAX 1024u                           /* as SPHC_MAP_BYTES_MAX */
SPHC_API sphc_status sphc_clock_mapper_memory(sphc_memory *memory); /* [pure] */
/* `config` is copied. Errors: ARGUMENT, STRUCT_SIZE, MEMORY_SIZE, MEMORY_ALIGNMENT. [pure] */
SPHC_API sphc_status sphc_clock_mapper_init(void *memory, size_t memory_bytes,
                                            const sphc_clock_mapper_config *config, sphc_clock_mapper **mapper,
                                            sphc_message *message);
SPHC_API void sphc_clock_mapper_fini(sphc_clock_mapper **mapper); /* [exclusive] */
/* One source time and when it arrived by the host's clock, in the order of arrival.  Arrivals are late by a varying
 * time, never early: the line below all of them is the mapping (Moon, Skelly, Towsley 1999).  SPHC_AGAIN: a clock
 * was set or ran backwards, or nothing came for an hour; all before is forgotten. [exclusive] */
SPHC_API sphc_status sphc_clock_mapper_add(sphc_clock_mapper *mapper, int64_t source_time_ns, int64_t arrival_ns);
/* *host_time_ns of a source time.  SPHC_AGAIN: no sample yet.  SPHC_E_ARGUMENT: more than an hour from the last
 * sample. [exclusive] */
SPHC_API sphc_status sphc_clock_mapper_map(const sphc_clock_mapper *mapper, int64_t source_time_ns,
                                           int64_t *host_time_ns);
/* Set mapping->struct_size first.  SPHC_AGAIN: no sample yet. [exclusive] */
SPHC_API sphc_status sphc_clock_mapper_get(const sphc_clock_mapper *mapper, sphc_clock_mapping *mapping);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_SPHERECLOUD_CAPTURE_H */
