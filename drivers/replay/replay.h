/* replay.h - plays a recording of colour and depth images back, as a source or frame by frame.
 *
 * A recording is one MCAP file or a raw file (docs/recording.md), which hold their calibration, one of another
 * program (docs/imports.md), or a folder in one of two layouts (docs/drivers.md) with a calibration file in it
 * (calibration.json) or elsewhere:
 *
 *     7-Scenes  frame-NNNNNN.color.{jpg,png}, frame-NNNNNN.depth.png, frame-NNNNNN.pose.txt; time = NNNNNN / 30 s
 *     TUM       rgb.txt, depth.txt, groundtruth.txt (optional); time as in these lists
 *
 *     sphc_replay_config config;
 *     sphc_replay_config_init(&config, sizeof config);
 *     sphc_replay_open(path, NULL, &config, &replay, &message);
 *     sphc_replay_source(replay, &source);             either: two streams in order of time
 *     sphc_replay_read_frame(replay, i, &frame, ...);  or: frames of colour and depth by index
 *     sphc_replay_close(&replay);
 *
 * Conventions (frames, units, pixels, failure, thread classes) are those of spherecloud.h.  Unlike the functions
 * there, opening allocates and reads files.  Image buffers are made at sphc_replay_open and at the first start or
 * read, and used again from then on; the PNG and JPEG decoders allocate while they decode.  No C++ exception leaves
 * these functions.  The library starts no thread.
 */
#ifndef SPHERECLOUD_DRIVERS_REPLAY_REPLAY_H
#define SPHERECLOUD_DRIVERS_REPLAY_REPLAY_H

#include <spherecloud/spherecloud_capture.h>

#include "host/recording/calibration.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sphc_replay sphc_replay;

/* ---- config ------------------------------------------------------------------------------------------------- */

typedef int32_t sphc_replay_mode;
enum {
  SPHC_REPLAY_FAST = 1,     /* acquire gives the next capture at once */
  SPHC_REPLAY_REAL_TIME = 2 /* a capture comes as long after start as it came in the recording, or later if the
                               caller is slow; none is ever dropped */
};

/* Bits of sphc_replay_config.streams. */
enum { SPHC_REPLAY_STREAM_COLOR = 1u, SPHC_REPLAY_STREAM_DEPTH = 2u };

/* Frames are chosen by the number of their colour image: NNNNNN in the 7-Scenes layout, the place in rgb.txt, from
 * 0, in the TUM layout.  A depth image goes with the colour image nearest in time, and with its frames. */
typedef struct sphc_replay_config {
  uint32_t struct_size;
  sphc_replay_mode mode;     /* FAST */
  uint32_t streams;          /* what the source gives; both */
  sphc_format color_format;  /* BGR8; or RGB8, GRAY8 */
  uint32_t first, last;      /* numbers of the first and the last frame; 0, UINT32_MAX */
  uint32_t step;             /* of these every step-th: first, first + step, ...; 1 */
  uint32_t loan_limit;       /* of the source; 1 to 64; 8 */
  int64_t pair_tolerance_ns; /* frames by index: colour and depth differ by at most this; 20 ms */
  int64_t pose_gap_ns;       /* poses are interpolated between recorded ones at most so far apart; 50 ms */
} sphc_replay_config;

/* The defaults stand behind the fields above.  Errors: ARGUMENT, STRUCT_SIZE. [pure] */
sphc_status sphc_replay_config_init(sphc_replay_config *config, size_t struct_size);

/* ---- open, close -------------------------------------------------------------------------------------------- */

/* Opens the recording at `path`, a folder or a file.  `calibration_path` null: calibration.json in it.  `config`
 * null: the defaults; it is copied.  No image is read yet; an MCAP file is read through for its checksums, and
 * refused where bytes outside of its chunks have changed. Errors: ARGUMENT (null, config, contents of the
 * calibration or of a list), STRUCT_SIZE, DEVICE (folder or file cannot be read, or holds no finished recording);
 * each with file, place, cause and cure in the message. [pure]
 */
sphc_status sphc_replay_open(const char *path, const char *calibration_path, const sphc_replay_config *config,
                             sphc_replay **replay, sphc_message *message);
/* Ends every loan and every borrowed image.  Accepts null and pointer to null; sets *replay to null. [exclusive] */
void sphc_replay_close(sphc_replay **replay);

/* ---- what is in it ------------------------------------------------------------------------------------------ */

typedef int32_t sphc_replay_layout;
enum {
  SPHC_REPLAY_7SCENES = 1,
  SPHC_REPLAY_TUM = 2,
  SPHC_REPLAY_MCAP = 3,
  SPHC_REPLAY_RAW = 4,
  SPHC_REPLAY_STRAY_SCANNER = 5,
  SPHC_REPLAY_ROS2 = 6,
  SPHC_REPLAY_RECORD3D = 7,
  SPHC_REPLAY_ROS1 = 8,
  SPHC_REPLAY_STREAM_RECORDER = 9,
  SPHC_REPLAY_AZURE_KINECT = 10,
  SPHC_REPLAY_HL2SS = 11 /* 5 to 11: of other programs, docs/imports.md */
};

typedef struct sphc_replay_info {
  uint32_t struct_size;
  sphc_replay_layout layout;
  uint32_t color_count, depth_count; /* images chosen by the config */
  uint32_t pose_count;               /* usable poses of the whole recording */
  uint32_t bad_pose_count;           /* poses left out: not finite, or no rotation */
  uint64_t lost_count;               /* captures that the recording says it lost, or without a time of their own */
  uint32_t bad_chunk_count;          /* of a file: parts left out because their bytes have changed */
  uint32_t is_cut;                   /* MCAP, 1: the end is missing, as after a power cut */
  uint32_t acceleration_count;       /* of the whole recording */
  uint32_t bad_acceleration_count;   /* left out: zero, not finite, or not later than the last */
} sphc_replay_info;
/* Set info->struct_size first.  Errors: ARGUMENT, STRUCT_SIZE. [shared] */
sphc_status sphc_replay_get_info(const sphc_replay *replay, sphc_replay_info *info);
/* The cameras, by the recording's calibration.  Errors: ARGUMENT. [shared] */
sphc_status sphc_replay_rig(const sphc_replay *replay, sphc_rig *rig);

/* ---- as a source -------------------------------------------------------------------------------------------- */

/* Fills *source (struct_size too) with the contract of spherecloud_capture.h; valid until sphc_replay_close.  A
 * handle has one source; a second call gives the same one.  Every start begins at the first chosen capture.
 * capture.time_ns is the recorded time, and so are clock, exposure and the rest where the recording knows them
 * (clocks are those of the host that recorded), capture.sequence the frame number (7-Scenes) or the place in the
 * list (TUM): frames that the config leaves out show as gaps. acquire: E_DEVICE when an image is missing or
 * corrupt, E_IMAGE when it does not fit the calibration; source.message names the file, and the next acquire goes
 * on behind it.  Errors: ARGUMENT. [exclusive] */
sphc_status sphc_replay_source(sphc_replay *replay, sphc_source *source);

/* ---- frame by frame ----------------------------------------------------------------------------------------- */

/* Frames are the chosen colour images that have a depth image within pair_tolerance_ns, in order of time; of
 * several the nearest.  Where the recording has frames itself, as a raw one has, these.  0 for null. [shared] */
uint32_t sphc_replay_frame_count(const sphc_replay *replay);

typedef struct sphc_replay_frame_info {
  uint32_t struct_size;
  uint32_t sequence; /* number of the colour image */
  int64_t color_time_ns;
  int64_t depth_time_ns;
  uint32_t has_pose; /* 1: sphc_replay_pose will give one */
  uint32_t reserved;
} sphc_replay_frame_info;
/* Set info->struct_size first.  Errors: ARGUMENT (index too), STRUCT_SIZE. [shared] */
sphc_status sphc_replay_get_frame_info(const sphc_replay *replay, uint32_t index, sphc_replay_frame_info *info);

/* Decodes frame `index` and fills *frame (struct_size too); frame->amplitude where the recording has one, GRAY16.
 * The images are owned by the handle and valid until its next read or its close; the source has buffers of its own
 * and does not disturb them. Errors: ARGUMENT, DEVICE (missing or corrupt image), IMAGE (does not fit the
 * calibration); the message names the file, and another frame can be read. [exclusive] */
sphc_status sphc_replay_read_frame(sphc_replay *replay, uint32_t index, sphc_localizer_frame *frame,
                                   sphc_message *message);

/* Recorded pose of the colour camera at the colour time of frame `index`; the world is the recording's own.
 * Exact when a pose has this very time, else interpolated (config.pose_gap_ns), else a pose at most 1 us away.
 * SPHC_NOT_LOCALIZED: the recording has none here; the output is untouched.  Errors: ARGUMENT. [shared] */
sphc_status sphc_replay_pose(const sphc_replay *replay, uint32_t index, sphc_rigid *world_from_camera);
/* The same at any time. [shared] */
sphc_status sphc_replay_pose_at(const sphc_replay *replay, int64_t time_ns, sphc_rigid *world_from_camera);
/* Pose `index` of info.pose_count as it was recorded, in order of time.  Errors: ARGUMENT. [shared] */
sphc_status sphc_replay_recorded_pose(const sphc_replay *replay, uint32_t index, int64_t *time_ns,
                                      sphc_rigid *world_from_camera);
/* What an accelerometer felt, number `index` of info.acceleration_count, in order of time and in the axes of the
 * colour camera: at rest 9.81 upwards.  Errors: ARGUMENT. [shared] */
sphc_status sphc_replay_acceleration(const sphc_replay *replay, uint32_t index, int64_t *time_ns,
                                     double felt_mps2[3]);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_REPLAY_REPLAY_H */
