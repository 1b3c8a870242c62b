/* simulated.h - a headset that exists only in memory: a furnished room, a colour camera, a ToF camera, and a person
 * who walks them through the room.  Everything is known exactly, so that what the library answers can be judged.
 *
 *     sphc_simulated_config_init, change what you like
 *     sphc_simulated_open                         builds and paints the room: a few seconds
 *     sphc_simulated_rig                          the cameras, for sphc_localizer_config
 *     sphc_simulated_source                       captures in order of time, as any driver gives them
 *     sphc_simulated_pose_at, _oracle_depth       the truth
 *     sphc_simulated_close
 *
 * Conventions are those of spherecloud.h (units in names, target_from_source, pixel centres at .5, status < 0
 * leaves outputs untouched but for a message).  Beyond them: World      origin in the middle of the floor, x along
 * the room's length, y along its width, z up; metres. Time       start_time_ns is mid-exposure of colour frame 0.
 * Frame i is at start + i / frame_rate_hz; its depth image depth_delay_ns later. Walk       one lap around the
 * middle of the room takes lap_s; lap two sees the same places from other positions and heights; after two laps the
 * path closes and repeats.  Frames of lap one make a map, frames of lap two query it.  The defaults (30 Hz, lap 16
 * s, 960 frames) are exactly two laps; frame_rate_hz 6.25 and frame_count 200 are the same walk with fewer frames.
 *   Same bytes The same config gives the same bytes, whatever `threads` says and in whatever order frames are
 * asked. Memory     this driver is a tool of the workstation: it allocates at open and while it renders (about 100
 * MB for the textures, as they come into view; eight times that in a flat). Threads    a handle never changes after
 * opening, but for the state of its one source; hence most of it is [shared].  Rendering starts up to `threads`
 * threads and joins them before it returns.
 */
#ifndef SPHERECLOUD_DRIVERS_SIMULATED_H
#define SPHERECLOUD_DRIVERS_SIMULATED_H

#include "spherecloud/spherecloud_capture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The image sizes of the headset's own cameras, which are the default; those of all are in sphc_simulated_rig. */
#define SPHC_SIMULATED_COLOR_WIDTH 640u
#define SPHC_SIMULATED_COLOR_HEIGHT 480u
#define SPHC_SIMULATED_DEPTH_WIDTH 320u
#define SPHC_SIMULATED_DEPTH_HEIGHT 288u
#define SPHC_SIMULATED_DEPTH_UNIT_M 0.001 /* metres per unit of the depth image */
#define SPHC_SIMULATED_LOAN_LIMIT 8u      /* captures that may be out on loan at once */

/* What makes the world hard, for sphc_simulated_config.with.  One floor and one light at a time. */
enum {
  SPHC_SIMULATED_HANDS = 1u << 0, /* the holder's hands come into view and leave it */
  SPHC_SIMULATED_FEET = 1u << 1,  /* the holder looks down at the own feet, three times a lap, at the same places */
  SPHC_SIMULATED_PEOPLE = 1u << 2,  /* three people walk around in the room */
  SPHC_SIMULATED_CARPET = 1u << 3,  /* floor: wall-to-wall carpet, a pattern of 9 cm that repeats exactly */
  SPHC_SIMULATED_PARQUET = 1u << 4, /* floor: blocks of six strips that repeat after 60 cm */
  SPHC_SIMULATED_TILES = 1u << 5,   /* floor: equal tiles of 25 cm */
  SPHC_SIMULATED_BARE = 1u << 6,    /* walls and ceiling of one colour with nothing on them */
  SPHC_SIMULATED_DOUBLES =
      1u << 7, /* each piece of furniture stands there twice, one poster hangs up to eight times */
  SPHC_SIMULATED_MIRROR = 1u << 8, /* a mirror of the height of a door: both cameras see the room in it */
  SPHC_SIMULATED_WINDOW = 1u << 9, /* a large window with a street far behind it, where depth has no measurement */
  SPHC_SIMULATED_DAY = 1u << 10,   /* light: lamps off, a bright sky and the sun through the window */
  SPHC_SIMULATED_NIGHT = 1u << 11, /* light: one floor lamp, warm and dim, black windows; more noise */
  SPHC_SIMULATED_DARK = 1u << 12,  /* light: lamps off at dusk; much noise, longer exposure */
  SPHC_SIMULATED_FLAT = 1u << 13,  /* eight rooms in a ring, with doorways; a lap goes through all of them */
  SPHC_SIMULATED_MENU = 1u << 14,  /* a line of text and a menu are drawn over the colour image */
  SPHC_SIMULATED_WALLPAPER = 1u << 15, /* all walls: one paper, a pattern of 53 cm that repeats exactly */
  SPHC_SIMULATED_BINDERS = 1u << 16    /* shelves along the walls, full of equal binders */
};
#define SPHC_SIMULATED_LAP_OF_FLAT_S 150.0 /* lap_s for a flat: about a third of a metre a second */

/* What the person wears or holds, for sphc_simulated_config.cameras.  The walk is the same. */
enum {
  SPHC_SIMULATED_CAMERAS_HEADSET = 0, /* colour 640 x 480 BROWN5, 63 degrees wide; ToF 320 x 288 KANNALA_BRANDT4 */
  SPHC_SIMULATED_CAMERAS_PHONE = 1,   /* colour 1440 x 1080 and depth 256 x 192, both BROWN5 without distortion, 67
                                         degrees wide; depth is as of the colour camera, with small holes filled and
                                         edges smoothed over 5 pixels */
  SPHC_SIMULATED_CAMERAS_WIDE = 2,    /* colour 640 x 480, 111 degrees wide, and ToF 320 x 288, 100 degrees wide,
                                         both KANNALA_BRANDT4 */
  SPHC_SIMULATED_CAMERAS_GLASSES =
      3 /* colour 480 x 360, 59 degrees wide, and depth of 64 x 48 zones, both BROWN5 */
};

typedef struct sphc_simulated_config {
  uint32_t struct_size;
  uint32_t frame_count;   /* colour frames, and as many depth frames; 1 to 1000000; default 960 */
  uint64_t seed;          /* the room: its size, furniture, textures, pictures; default 1 */
  uint64_t walk_seed;     /* the walk and all noise; default 1 */
  double frame_rate_hz;   /* 0.1 to 240; default 30 */
  double lap_s;           /* seconds a lap; 4 to 3600; default 16 (about 0.45 m/s and 25 degrees/s), which is for a
                             room: see SPHC_SIMULATED_LAP_OF_FLAT_S */
  int64_t start_time_ns;  /* 0 to 2^61; default 1 s */
  int64_t depth_delay_ns; /* depth minus colour mid-exposure time; less than half a frame period either way; 4 ms */
  uint32_t threads;       /* at most this many in a render; 0: as many as the machine has cores; at most 64 */

  /* Colour.  The switches are 0 or 1. */
  uint32_t color_noise;    /* shot and read noise; default 1 */
  uint32_t motion_blur;    /* default 1 */
  uint32_t exposure_drift; /* brightness wanders slowly, as auto-exposure makes it; default 1 */
  double exposure_s;       /* 0 to 0.05; the span of the motion blur; default 0.008 */

  /* Depth.  Measured z' = depth_scale z + depth_offset_m + a wiggle of amplitude depth_wiggle_m, plus noise of
   * sigma(z) = (depth_sigma_m + depth_sigma_per_m2 z^2) times a factor of 0.6 to 3 that falls with the light that
   * comes back (dark or grazing surfaces are worse).  z is in metres along the ToF camera's axis. */
  uint32_t ideal_depth;  /* 1: z at the pixel centre, rounded to the unit: no noise, bias, mixed or missing pixels;
                            the five numbers below are then unused; default 0 */
  uint32_t with;         /* what makes the world hard: SPHC_SIMULATED_HANDS | ...; default 0 */
  double depth_scale;    /* 0.8 to 1.2; default 1.001 */
  double depth_offset_m; /* -0.5 to 0.5; default 0.001 */
  double depth_wiggle_m; /* 0 to 0.1; default 0.0015 */
  double depth_sigma_m;  /* 0 to 1; default 0.0013 */
  double depth_sigma_per_m2; /* 0 to 1; default 0.0007 */
  double depth_max_m;        /* no measurement beyond this distance from the camera; 0.5 to 60; default 6 */

  /* Between a map and a query. */
  uint64_t arrangement_seed; /* other than 0: of what people move (chairs, boxes, plants, books, small things,
                                pictures) about half stands elsewhere and a quarter is gone; default 0 */
  double walk_start_s;       /* where on the walk frame 0 is; 0 to 1e6; lap_s is the begin of lap two; default 0 */

  uint32_t raw_depth; /* 1: what a ToF module measures before it drops what it does not believe: noise where little
                         light comes back, anything where nearly none does, all mixed pixels of edges; the source's
                         depth captures then have amplitudes; not with those of a phone; default 0 */
  uint32_t cameras;   /* SPHC_SIMULATED_CAMERAS_...; default that of a headset */

  /* A rolling shutter of the colour camera: from a row's exposure to that of the row below it, either way; the
   * middle of the image is exposed at the frame's time.  SPHC_ROW_TIME_MAX_NS at most; default 0, all at once. */
  int64_t color_row_time_ns;
} sphc_simulated_config;

typedef struct sphc_simulated sphc_simulated;

/* Fills *config with the defaults above and sets struct_size.  ARGUMENT: config is null.  STRUCT_SIZE: the size is
 * none this library knows. [pure] */
sphc_status sphc_simulated_config_init(sphc_simulated_config *config, size_t struct_size);

/* The bits of names as in "feet,people,tiles", in any order; "" gives 0.  *with is written on success.  ARGUMENT: a
 * null pointer, or a name that is none (which, and all there are). [pure] */
sphc_status sphc_simulated_parse_with(const char *names, uint32_t *with, sphc_message *message);

/* The number of "headset", "phone", "wide" or "glasses".  *cameras is written on success.  ARGUMENT: a null
 * pointer, or a name that is none (which, and all there are). [pure] */
sphc_status sphc_simulated_parse_cameras(const char *name, uint32_t *cameras, sphc_message *message);
/* The name of a number; "unknown" of any other. [pure] */
const char *sphc_simulated_cameras_name(uint32_t cameras);

/* Builds and paints the room.  `config` is copied.  On success *simulated is owned by the caller, who closes it.
 * Errors: ARGUMENT (which field, the value seen and the range), STRUCT_SIZE, MEMORY_SIZE (out of memory), INTERNAL.
 * [pure] */
sphc_status sphc_simulated_open(const sphc_simulated_config *config, sphc_simulated **simulated,
                                sphc_message *message);

/* Stops its source, frees everything and sets *simulated to null.  Accepts null and pointer to null.  No image of
 * the source may be used after it. [exclusive] */
void sphc_simulated_close(sphc_simulated **simulated);

/* Fills the source contract; set source->struct_size first.  `source->self` borrows the handle until it is closed;
 * one handle has one source, and all its functions are [exclusive] together.  Captures come in order of time,
 * colour RGB8 and depth DEPTH16, frame_count of each, then SPHC_END; no frame is ever lost or waited for, so
 * timeout_us has no effect and SPHC_AGAIN never comes.  Set capture->struct_size before acquire.  stop, then start
 * begins again from frame 0.  Errors of this call: ARGUMENT, STRUCT_SIZE. [shared] */
sphc_status sphc_simulated_source(sphc_simulated *simulated, sphc_source *source);

/* The exact calibration, and the sizes of all images: of config.cameras, the same for every seed.  ARGUMENT: a null
 * pointer. [shared] */
sphc_status sphc_simulated_rig(const sphc_simulated *simulated, sphc_rig *rig);

/* How many colour frames the source gives (config.frame_count); 0 for null. [shared] */
uint32_t sphc_simulated_frame_count(const sphc_simulated *simulated);

/* Mid-exposure times of frame `index`.  Each output may be null.  ARGUMENT: null handle, or index >= frame_count.
 * [shared] */
sphc_status sphc_simulated_frame_times(const sphc_simulated *simulated, uint32_t index, int64_t *color_time_ns,
                                       int64_t *depth_time_ns);

/* Exact pose of the colour camera at any time of the start_time_ns clock, also between, before and after the
 * frames. ARGUMENT: a null pointer. [shared] */
sphc_status sphc_simulated_pose_at(const sphc_simulated *simulated, int64_t time_ns, sphc_rigid *world_from_camera);

/* What an accelerometer in the colour camera measures at any time, in the camera's axes: at rest 9.81 upwards.
 * Noise of 0.03 m/s^2 and a bias of about 0.04 on each axis, by the walk's seed.  ARGUMENT: a null pointer.
 * [shared] */
sphc_status sphc_simulated_felt_at(const sphc_simulated *simulated, int64_t time_ns, double felt_mps2[3]);

/* Exact z depth in metres, along the colour camera's axis, at the centre of every colour pixel at this time;
 * row-major, a float for each colour pixel, in caller memory.  No noise, no blur.  0 never happens: the room is
 * closed.  In a mirror it is the depth of what is seen there, behind the glass of a window that of the street.
 * Errors: ARGUMENT, MEMORY_SIZE, INTERNAL. [shared] */
sphc_status sphc_simulated_oracle_depth(const sphc_simulated *simulated, int64_t time_ns, float *depth_m);

/* The same for the ToF camera: z along its own axis, a float for each of its pixels. [shared] */
sphc_status sphc_simulated_oracle_tof_depth(const sphc_simulated *simulated, int64_t time_ns, float *depth_m);

/* Renders the colour image of frame `index` (RGB8, tightly packed, 3 bytes a pixel of the colour camera) into
 * caller memory: the very bytes the source gives.  Errors: ARGUMENT, MEMORY_SIZE, INTERNAL. [shared] */
sphc_status sphc_simulated_render_color(const sphc_simulated *simulated, uint32_t index, uint8_t *rgb);

/* Renders the depth image of frame `index` (tightly packed, a value in DEPTH_UNIT_M for each pixel of the ToF
 * camera) into caller memory: the very bytes the source gives.  Errors: ARGUMENT, MEMORY_SIZE, INTERNAL. [shared]
 */
sphc_status sphc_simulated_render_depth(const sphc_simulated *simulated, uint32_t index, uint16_t *depth);

/* The light that came back to each pixel of the depth image of frame `index`, as its sensor counts it: 5500 from a
 * wall of reflectance 0.55 at 1 m, falling with the square of the distance; what is below SPHC_SIMULATED_FAINT is
 * not to be believed.  As many values as depth has, in caller memory, for sphc_localizer_frame.amplitude
 * (GRAY16). Errors: ARGUMENT, MEMORY_SIZE, INTERNAL. [shared] */
#define SPHC_SIMULATED_FAINT 75u
sphc_status sphc_simulated_render_amplitude(const sphc_simulated *simulated, uint32_t index, uint16_t *amplitude);

/* What a camera sees that the headset does not have, such as the further cameras of a rig: at a moment of the
 * start_time_ns clock, still, where world_from_camera is; with the noise of the headset's own.  The camera is
 * BROWN5 or KANNALA_BRANDT4, its width a multiple of 16, and it sees less than 85 degrees off its axis.  rgb is
 * RGB8, depth in DEPTH_UNIT_M as of a ToF camera, depth_m exact z in metres; each tightly packed in caller memory,
 * and each may be null.  Errors: ARGUMENT, MEMORY_SIZE, INTERNAL. [shared] */
sphc_status sphc_simulated_render_view(const sphc_simulated *simulated, int64_t time_ns, const sphc_camera *camera,
                                       const sphc_rigid *world_from_camera, uint8_t *rgb, uint16_t *depth,
                                       float *depth_m);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_SIMULATED_H */
