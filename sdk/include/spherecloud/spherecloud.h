/* spherecloud.h - the public C interface of the SphereCloud SDK.  Cameras and clocks: spherecloud_capture.h.
 *
 * What it does.  Given a colour image and a time-of-flight (ToF) depth image taken at about the same time,
 * and a map that was built beforehand, the library answers where the camera is in the map.  The map is a
 * *sphere cloud* (Moon et al., "Depth-Guided Privacy-Preserving Visual Localization Using 3D Sphere Clouds",
 * BMVC 2024): of every map point it keeps only the direction from the map's centre, mixed with fake
 * directions, so that the file holds no 3D geometry.
 *
 * A session, in the order of the calls:
 *
 *     sphc_map_memory, sphc_map_init              view a map file that you loaded or mapped, one for each room
 *     sphc_localizer_config_init, set the rig     describe the headset
 *     sphc_localizer_memory, sphc_localizer_init  hand over memory once
 *     sphc_localizer_set_map                      give it the map, or several; between frames at any time
 *     sphc_localizer_process ...                  a frame in, a pose out; never allocates; or in two halves,
 *                                                 sphc_localizer_extract and sphc_localizer_locate
 *     sphc_localizer_fini, sphc_map_fini
 *
 * Frames.  `target_from_source` everywhere: x_target = R(q) x_source + t.  Camera axes are OpenCV's: x right, y
 * down, z forward.  The map frame has its origin at the sphere centre.
 *
 * Units.  Metres, nanoseconds, radians and pixels; the name says which (`_m`, `_ns`, `_rad`, `_px`).
 *
 * Pixels.  The centre of the top-left pixel is (0.5, 0.5), as in COLMAP.  OpenCV calls the same point (0, 0): add
 * 0.5 to an OpenCV principal point.
 *
 * Memory.  "Borrows": reads only until the call returns unless a longer time is stated.  "Caller memory": the
 * library never resizes, frees or copies it away.  No function of this header allocates, and none frees: where an
 * instance is no longer wanted, its memory may also go without a call of _fini.
 *
 * Failure.  status < 0: outputs are untouched, except a message that explains.  What a function's comment does not
 * list it may return too: SPHC_E_ARGUMENT for a null that it cannot take or an index out of range, and
 * SPHC_E_STRUCT_SIZE where it takes a struct that has a struct_size.
 *
 * Names.  What belongs to a module begins with its name: sphc_map_, sphc_aligner_, sphc_localizer_, sphc_features_.
 * What all share has none: sphc_image.  Constants leave the module out: sphc_localizer_outcome has SPHC_OUTCOME_.
 * `map_id` is a map, `point_index` a point.
 *
 * Structs.  Those that begin with `struct_size` grow at the end only; set it to sizeof (the _init functions do),
 * and zero what you do not set.  A program may be built with an older header than its library, whose new fields
 * then have their defaults, or with a newer one, of which what the library does not know must be zero:
 * SPHC_E_UNSUPPORTED otherwise, as where a reserved field is not zero.  Results come back as far as the caller's
 * struct goes, zeroes in what the library does not know.  Atoms (sphc_message, sphc_rigid, sphc_camera, sphc_rig,
 * sphc_image, sphc_memory, sphc_memory_piece, sphc_depth_bias, sphc_keypoint) never change.
 *
 * Threads.  The class stands in brackets behind every function.  [pure] touches no instance but those being made;
 * any thread, any time.  [shared] may run at the same time on one instance.  [exclusive]: one call at a time per
 * instance. The library starts no thread, takes no lock, and has no mutable global of its own.
 *
 * Callbacks are called on the thread of the call, config.parallel's tasks apart.  They must return: no exception,
 * no longjmp.  They must not call the library with the instance that calls them.
 */
#ifndef SPHERECLOUD_SPHERECLOUD_H
#define SPHERECLOUD_SPHERECLOUD_H

#include <stddef.h>
#include <stdint.h>

#if defined(SPHC_STATIC)
#define SPHC_API
#elif defined(_WIN32)
#if defined(SPHC_BUILDING)
#define SPHC_API __declspec(dllexport)
#else
#define SPHC_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define SPHC_API __attribute__((visibility("default")))
#else
#define SPHC_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version ---- */

#define SPHC_VERSION_MAJOR 1
#define SPHC_VERSION_MINOR 0
#define SPHC_VERSION_PATCH 0
#define SPHC_VERSION_CANDIDATE 1 /* which candidate for that release; 0: the release */
#define SPHC_ABI 1u              /* raised only when an existing symbol or the prefix of a struct changes */

/* ABI the library was built with; compare with SPHC_ABI before anything else. [pure] */
SPHC_API uint32_t sphc_abi(void);
/* "major.minor.patch", of a candidate with "-rc1" behind it, or its number; static storage. [pure] */
SPHC_API const char *sphc_version_string(void);

/* ---- status and message ---- */

/* 0: done.  > 0: an answer that is not a failure, outputs as documented.  < 0: failure, outputs untouched.
 * Values are pinned: never renumbered, never reused. */
typedef int32_t sphc_status;
enum {
  SPHC_OK = 0,
  SPHC_AGAIN = 1,         /* nothing yet: within the timeout, or until more input comes */
  SPHC_NOT_LOCALIZED = 2, /* there is no pose: none passed the checks, result.outcome says which; or none is known
                             at the time that a prediction was asked for */
  SPHC_END = 3,           /* a finite source (a recording) has no more captures */
  SPHC_OUTSIDE = 4,       /* a camera has no pixel for this point, or no bearing for this pixel */

  SPHC_E_ARGUMENT = -10,    /* null, not finite, out of range, or at odds with another argument */
  SPHC_E_STRUCT_SIZE = -11, /* struct_size is none that this struct ever had */
  SPHC_E_STATE = -12,       /* the call is not allowed in the current state */
  SPHC_E_IMAGE = -13,       /* an image's size, stride, format or pointer does not fit the config */

  SPHC_E_MEMORY_SIZE = -20,
  SPHC_E_MEMORY_ALIGNMENT = -21,
  SPHC_E_CAPACITY = -22, /* an input exceeds a capacity fixed in the config */

  SPHC_E_MAP_FORMAT = -30,    /* not a sphere-cloud file, cut short, or its fields contradict each other */
  SPHC_E_MAP_VERSION = -31,   /* made in another version of the format: build it again */
  SPHC_E_MAP_CHECKSUM = -32,  /* bytes changed since it was written */
  SPHC_E_MAP_EXTRACTOR = -33, /* descriptors, of a map or of features, were made by another extractor than this
                                 library's */

  SPHC_E_DEVICE = -40,
  SPHC_E_DEVICE_LOST = -41, /* unplugged; stop, and open again once it is back */

  SPHC_E_UNSUPPORTED = -50, /* not by this library or device: a field of a newer header is set, a mode is missing */
  SPHC_E_INTERNAL = -90     /* a defect of this library; please report */
};

/* "SPHC_OK" and so on; "SPHC_?" for a value this library does not know; never null; static storage. [pure] */
SPHC_API const char *sphc_status_name(sphc_status status);

/* Room for one explanation: what was wrong, with the values seen, and what to do.  Every argument of this type is
 * caller memory and may be null.  Written only on failure; always terminated; ASCII. */
#define SPHC_MESSAGE_BYTES 256u
typedef struct sphc_message {
  char text[SPHC_MESSAGE_BYTES];
} sphc_message;

/* ---- atoms: frozen layouts ---- */

/* How the pixels of an image lie in its bytes.  Values of a colour image are read for their luma; what else is
 * there is not looked at.  docs/formats.md says which format of V4L2, libcamera, Android or DirectShow is which. */
typedef int32_t sphc_format;
enum {
  SPHC_FORMAT_GRAY8 = 1, /* 1 byte a pixel */
  SPHC_FORMAT_RGB8 = 2,  /* 3 bytes a pixel: red, green, blue */
  SPHC_FORMAT_BGR8 = 3,  /* 3 bytes a pixel: blue, green, red */
  SPHC_FORMAT_RGBA8 = 4, /* 4 bytes a pixel: red, green, blue, any */
  SPHC_FORMAT_BGRA8 = 5, /* 4 bytes a pixel: blue, green, red, any */
  SPHC_FORMAT_NV12 = 6,  /* data is the plane of luma, 1 byte a pixel; read in place.  NV21, NV16 and NV24 too */
  SPHC_FORMAT_I420 = 7,  /* the same; YV12, I422 and I444 too */
  SPHC_FORMAT_YUYV = 8,  /* 2 bytes a pixel: luma, chroma */
  SPHC_FORMAT_UYVY = 9,  /* 2 bytes a pixel: chroma, luma */

  /* Depth: z along the depth camera's axis, or range, the distance from its centre.  What is 0, negative or not
   * finite is no measurement. */
  SPHC_FORMAT_DEPTH16 = 10,   /* uint16 z, native byte order; metres per unit stand in the rig */
  SPHC_FORMAT_DEPTH12P = 11,  /* 12 bits z in the rig's units, 2 pixels in 3 bytes as in MIPI RAW12; width even */
  SPHC_FORMAT_DEPTH_F32 = 12, /* float z in metres, native byte order */
  SPHC_FORMAT_RANGE16 = 13,   /* uint16 range, native byte order, in the rig's units */
  SPHC_FORMAT_RANGE12P = 14,  /* 12 bits range in the rig's units, packed as DEPTH12P; width even */
  SPHC_FORMAT_RANGE_F32 = 15, /* float range in metres, native byte order */

  /* Grey of more than 8 bits, of which the highest 8 are read. */
  SPHC_FORMAT_GRAY10 = 20,  /* 2 bytes a pixel, little-endian, the value in the lower 10 bits */
  SPHC_FORMAT_GRAY12 = 21,  /* the same, 12 bits */
  SPHC_FORMAT_GRAY16 = 22,  /* the same, 16 bits */
  SPHC_FORMAT_GRAY10P = 23, /* 4 pixels in 5 bytes, as in MIPI RAW10; width a multiple of 4 */
  SPHC_FORMAT_GRAY12P = 24, /* 2 pixels in 3 bytes, as in MIPI RAW12; width even */

  /* A colour filter of 2 x 2 pixels, named by its first row and its second; packed as the grey of that name.  Its
   * green is read, and where a pixel has another colour, the mean of the greens beside it. */
  SPHC_FORMAT_BAYER_RGGB8 = 32,
  SPHC_FORMAT_BAYER_GRBG8 = 33,
  SPHC_FORMAT_BAYER_GBRG8 = 34,
  SPHC_FORMAT_BAYER_BGGR8 = 35,
  SPHC_FORMAT_BAYER_RGGB10 = 36,
  SPHC_FORMAT_BAYER_GRBG10 = 37,
  SPHC_FORMAT_BAYER_GBRG10 = 38,
  SPHC_FORMAT_BAYER_BGGR10 = 39,
  SPHC_FORMAT_BAYER_RGGB12 = 40,
  SPHC_FORMAT_BAYER_GRBG12 = 41,
  SPHC_FORMAT_BAYER_GBRG12 = 42,
  SPHC_FORMAT_BAYER_BGGR12 = 43,
  SPHC_FORMAT_BAYER_RGGB16 = 44,
  SPHC_FORMAT_BAYER_GRBG16 = 45,
  SPHC_FORMAT_BAYER_GBRG16 = 46,
  SPHC_FORMAT_BAYER_BGGR16 = 47,
  SPHC_FORMAT_BAYER_RGGB10P = 48,
  SPHC_FORMAT_BAYER_GRBG10P = 49,
  SPHC_FORMAT_BAYER_GBRG10P = 50,
  SPHC_FORMAT_BAYER_BGGR10P = 51,
  SPHC_FORMAT_BAYER_RGGB12P = 52,
  SPHC_FORMAT_BAYER_GRBG12P = 53,
  SPHC_FORMAT_BAYER_GBRG12P = 54,
  SPHC_FORMAT_BAYER_BGGR12P = 55
};
/* Bytes of a pixel; 0 for a format that this library does not know, or whose pixels share bytes. [pure] */
SPHC_API uint32_t sphc_format_bytes(sphc_format format);
/* Bytes of a row of so many pixels, the least stride; 0 for a format that this library does not know, and for a
 * width that it cannot have. [pure] */
SPHC_API uint32_t sphc_format_row_bytes(sphc_format format, uint32_t width);
/* "SPHC_FORMAT_GRAY8" and so on; "SPHC_FORMAT_?" for any other value; never null; static storage.  So do all
 * functions that end in _name, of bits for one bit. [pure] */
SPHC_API const char *sphc_format_name(sphc_format format);

/* Rigid transform; named target_from_source everywhere: x_target = R(q) x_source + t. */
typedef struct sphc_rigid {
  double q_wxyz[4]; /* unit quaternion, real part first */
  double t_m[3];
} sphc_rigid;

typedef int32_t sphc_camera_model;
enum {
  SPHC_CAMERA_PINHOLE = 1,        /* fx fy cx cy */
  SPHC_CAMERA_BROWN5 = 2,         /* fx fy cx cy k1 k2 p1 p2 k3           (OpenCV's order) */
  SPHC_CAMERA_BROWN8 = 3,         /* fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6  (OpenCV's rational model) */
  SPHC_CAMERA_KANNALA_BRANDT4 = 4 /* fx fy cx cy k1 k2 k3 k4              (OpenCV's fisheye) */
};
SPHC_API const char *sphc_camera_model_name(sphc_camera_model model); /* [pure] */

/* The light that a camera sees.  A place looks different in each, so a map serves cameras of its own alone. */
typedef int32_t sphc_band;
enum {
  SPHC_BAND_VISIBLE = 0, /* colour or grey */
  SPHC_BAND_INFRARED = 1 /* near infrared: an infrared camera, or the amplitude image of a ToF sensor */
};
SPHC_API const char *sphc_band_name(sphc_band band); /* [pure] */

/* Camera intrinsics, in pixels of an image of width x height. */
typedef struct sphc_camera {
  sphc_camera_model model;
  uint32_t width, height;
  uint32_t param_count; /* 4, 9, 12 or 8, by model */
  double params[12];    /* unused ones are 0 */
} sphc_camera;

/* The colour and the depth camera of a headset: what a calibration file holds, and what everything that needs
 * cameras takes.  Identity with equal cameras: the depth image is already registered to colour. */
typedef struct sphc_rig {
  sphc_camera color_camera, depth_camera; /* any of the models, distortion included */
  sphc_rigid color_from_depth;
  double depth_unit_m; /* metres per unit of the depth image */
} sphc_rig;

typedef struct sphc_image {
  /* Caller memory; top-left pixel, of the first plane where there are several.  Aligned to the bytes of a value: 2
   * in 16-bit formats, 4 in float.  Nothing is read behind the last row's sphc_format_row_bytes. */
  const void *data;
  uint32_t width, height;
  /* From a row to the next: sphc_format_row_bytes to SPHC_STRIDE_MAX_BYTES, aligned as data. */
  uint32_t stride_bytes;
  sphc_format format;
} sphc_image;
#define SPHC_STRIDE_MAX_BYTES 1048576u

/* What an instance needs of the caller: for the functions that end in _memory. */
typedef struct sphc_memory {
  uint64_t state_bytes; /* lives as long as the instance */
  uint64_t
      scratch_bytes;  /* used only inside a call; instances of one thread may share it; 0 where none is needed */
  uint32_t alignment; /* of both */
  uint32_t reserved;
} sphc_memory;

/* ---- camera, rig and rigid transform functions ---- */

/* The limits of sphc_camera_check and sphc_rig_check; there are no others. */
#define SPHC_CAMERA_MIN_PX 16u         /* width and height */
#define SPHC_CAMERA_MAX_PX 8192u       /* the same */
#define SPHC_CAMERA_MAX_PARAM 1e6      /* of a parameter, either sign; of real cameras they are far below */
#define SPHC_RIG_MAX_OFFSET_M 10.0     /* of a part of color_from_depth.t_m, either sign; more are millimetres */
#define SPHC_RIG_MAX_LENGTH_ERROR 1e-3 /* of color_from_depth.q_wxyz, whose length is 1 */
#define SPHC_RIG_MIN_UNIT_M 1e-6       /* depth_unit_m */
#define SPHC_RIG_MAX_UNIT_M 0.1        /* the same */

/* SPHC_OK if the camera can be used: known model, right param_count, parameters and size within the limits, fx and
 * fy > 0, and 0 in what the model does not use.  Else SPHC_E_ARGUMENT; the message names field, cause and cure.
 * [pure] */
SPHC_API sphc_status sphc_camera_check(const sphc_camera *camera, sphc_message *message);
/* Pixel of a point in camera coordinates.  SPHC_OUTSIDE, *pixel_px untouched, if it is not in front of the camera,
 * is more than about 89 degrees off its axis (83 for the Brown models), or lies where the distortion is not
 * invertible.  SPHC_E_ARGUMENT: null, not finite, or a camera that sphc_camera_check refuses. [pure] */
SPHC_API sphc_status sphc_camera_project(const sphc_camera *camera, const double point_m[3], double pixel_px[2]);
/* Unit bearing (camera coordinates) of a pixel.  SPHC_OUTSIDE, *bearing untouched, if no bearing within that
 * angle projects there.  SPHC_E_ARGUMENT: as above. [pure] */
SPHC_API sphc_status sphc_camera_unproject(const sphc_camera *camera, const double pixel_px[2], double bearing[3]);

/* Identity and millimetres; the cameras stay zero and must be set.  Does nothing for null. [pure] */
SPHC_API void sphc_rig_init(sphc_rig *rig);
/* SPHC_OK if the rig can be used: both cameras pass sphc_camera_check, transform and unit are within the limits.
 * Else SPHC_E_ARGUMENT; the message names field, cause and cure.  Whatever takes a rig calls this: a rig that one
 * takes, all take. [pure] */
SPHC_API sphc_status sphc_rig_check(const sphc_rig *rig, sphc_message *message);

/* c_from_a = c_from_b * b_from_a; c_from_a may be one of the inputs.  Quaternions are normalised, and one of zeros
 * counts as the identity; what is not finite makes the result NaN.  Does nothing for null. [pure] */
SPHC_API void sphc_rigid_compose(const sphc_rigid *c_from_b, const sphc_rigid *b_from_a, sphc_rigid *c_from_a);
/* a_from_b = inverse of b_from_a; both may be the same object.  Numbers and null as sphc_rigid_compose. [pure] */
SPHC_API void sphc_rigid_inverse(const sphc_rigid *b_from_a, sphc_rigid *a_from_b);
/* x_b = b_from_a x_a; x_b may be x_a.  Numbers and null as sphc_rigid_compose. [pure] */
SPHC_API void sphc_rigid_apply(const sphc_rigid *b_from_a, const double x_a[3], double x_b[3]);

/* How another system states poses: seven numbers in its own order.  A camera's pose is world_from_camera, but for
 * COLMAP.  Of a world only the vertical and the handedness are fixed; origin and heading are the caller's.
 *
 * `world_from_map` says where the map lies in the other system's world, which is right-handed here: where the
 * system is left-handed, nothing but the seven numbers is mirrored.  make_world and read_map give it, or a pose
 * that is known in the map and in that world.  Null is the map's own frame, for COLMAP and TUM alone, whose worlds
 * need no vertical.  docs/frames.md has examples that can be checked by hand.
 *
 * Errors of the functions: ARGUMENT: null, not finite, beyond a limit; UNSUPPORTED: a convention that this library
 * does not know.  The message names cause and cure.  An output may be an input. */
typedef int32_t sphc_convention;
enum {
  SPHC_CONVENTION_OPENXR = 1, /* qx qy qz qw x y z; camera x right, y up, z back; world y up; so ARKit and ARCore */
  SPHC_CONVENTION_UNITY = 2,  /* x y z qx qy qz qw; camera x right, y up, z forward; world y up, left-handed: that
                               * of OPENXR with z the other way, as in Unity's own OpenXR */
  SPHC_CONVENTION_ROS_OPTICAL = 3, /* x y z qx qy qz qw; camera as here; world z up */
  SPHC_CONVENTION_ROS_FLU = 4,     /* x y z qx qy qz qw; camera x forward, y left, z up; world z up */
  SPHC_CONVENTION_COLMAP = 5, /* qw qx qy qz x y z of camera_from_world; camera as here; a level world has y down */
  SPHC_CONVENTION_TUM = 6     /* x y z qx qy qz qw; camera as here; a level world has z up */
};
SPHC_API const char *sphc_convention_name(sphc_convention convention); /* [pure] */

/* The limits of what is taken.  Quaternions that come out have qw >= 0, and where that is 0 the first that is not
 * is positive, so that numbers can be compared. */
#define SPHC_CONVENTION_MAX_OFFSET_M 1e9      /* of a part of a translation, either sign */
#define SPHC_CONVENTION_MAX_LENGTH_ERROR 1e-3 /* of a quaternion, whose length is 1 */

/* A gravity-aligned world with the map's origin.  `up_map`: upwards, in the map's frame; any length but 0.  The
 * shortest turn takes up_map to z; then x stays and z becomes what is up: y for OPENXR and UNITY, z for ROS and
 * TUM, -y for COLMAP.  A map that is so already gets the identity.  The heading changes smoothly with up_map,
 * except where that is -z; there x is kept. [pure] */
SPHC_API sphc_status sphc_convention_make_world(sphc_convention convention, const double up_map[3],
                                                sphc_rigid *world_from_map, sphc_message *message);
/* A camera's pose to the other system, and back.  To read a pose in a world that is no map, such as odometry's,
 * give the identity; what comes out is camera_from_world. [pure] */
SPHC_API sphc_status sphc_convention_write_camera(sphc_convention convention, const sphc_rigid *world_from_map,
                                                  const sphc_rigid *camera_from_map, double pose[7],
                                                  sphc_message *message);
SPHC_API sphc_status sphc_convention_read_camera(sphc_convention convention, const sphc_rigid *world_from_map,
                                                 const double pose[7], sphc_rigid *camera_from_map,
                                                 sphc_message *message);
/* The map's pose in the other system's world, world_from_map in all conventions: a transform between two frames of
 * ROS, or the node under which hangs what is placed in the map (in UNITY with its z the other way). [pure] */
SPHC_API sphc_status sphc_convention_write_map(sphc_convention convention, const sphc_rigid *world_from_map,
                                               double pose[7], sphc_message *message);
SPHC_API sphc_status sphc_convention_read_map(sphc_convention convention, const double pose[7],
                                              sphc_rigid *world_from_map, sphc_message *message);

/* ---- map: an immutable view of borrowed bytes ---- */

typedef struct sphc_map sphc_map;

typedef struct sphc_map_info {
  uint32_t struct_size;
  uint32_t format_version;
  uint32_t point_count; /* real and fake together; the file does not tell them apart */
  uint32_t extractor;   /* id of the keypoint extractor that described the points */
  uint64_t file_bytes;
  uint8_t map_id[16]; /* name of this release, by what it holds; docs/map_format.md */
  sphc_band band;     /* of the images that it was made of */
  uint32_t reserved;
} sphc_map_info;

/* The id of this library's keypoint extractor; a map whose points another one described is refused. [pure] */
SPHC_API uint32_t sphc_extractor_id(void);
/* What sphc_map_init needs for its view (not for the file). [pure] */
#define SPHC_MAP_BYTES_MAX 256u /* state_bytes of any library of this ABI, for memory that is not asked for */
SPHC_API sphc_status sphc_map_memory(sphc_memory *memory);
/* Validates the whole file (structure, checksums, every direction) and makes a view of it in caller memory.
 * `file` is borrowed until sphc_map_fini and must not change; 8-byte aligned.  Reads each byte once: about 1 ms a
 * MB.  Errors: MEMORY_SIZE, MEMORY_ALIGNMENT, MAP_FORMAT, MAP_VERSION, MAP_CHECKSUM, MAP_EXTRACTOR, ARGUMENT.
 * [pure]
 */
SPHC_API sphc_status sphc_map_init(void *memory, size_t memory_bytes, const void *file, size_t file_bytes,
                                   sphc_map **map, sphc_message *message);
/* Set info->struct_size first. [shared] */
SPHC_API sphc_status sphc_map_get_info(const sphc_map *map, sphc_map_info *info);
/* Unit direction of a point from the sphere centre, map frame; point_index counts from 0. [shared] */
SPHC_API sphc_status sphc_map_direction(const sphc_map *map, uint32_t point_index, double direction[3]);
/* Ends the view; accepts null and pointer to null; sets *map to null; frees nothing. [exclusive] */
SPHC_API void sphc_map_fini(sphc_map **map);

/* ---- depth alignment: a whole depth image, seen from the colour camera ---- */

/* What a pixel of an aligned image is. */
typedef int32_t sphc_aligned_pixel;
enum {
  SPHC_ALIGNED_HOLE = 0,     /* no depth: not measured, out of range, or out of the depth camera's view */
  SPHC_ALIGNED_MEASURED = 1, /* a measurement falls into this pixel */
  SPHC_ALIGNED_FILLED = 2,   /* between measurements of one surface: interpolated */
  SPHC_ALIGNED_OCCLUDED = 3  /* no depth: something nearer hides this place from the depth camera */
};

SPHC_API const char *sphc_aligned_pixel_name(sphc_aligned_pixel pixel); /* [pure] */

typedef struct sphc_aligner_config {
  uint32_t struct_size;
  sphc_format depth_format; /* of the images to align, a DEPTH or RANGE format; 0: SPHC_FORMAT_DEPTH16 */
  sphc_rig rig;
  /* Measurements outside are ignored; at most 65535 units of the rig, and 62000 of aligned_unit_m. */
  double depth_min_m, depth_max_m;
  /* Noise of the depth sensor, 1 sigma: sigma(z) = depth_sigma_m + depth_sigma_per_m2 z^2; for the confidence. */
  double depth_sigma_m, depth_sigma_per_m2;
  double aligned_unit_m; /* metres per unit of the aligned image; 0: rig.depth_unit_m */
} sphc_aligner_config;

/* Where an aligned image goes: caller memory, of the colour camera's size.  Each pointer may be null.  No pixel
 * may be one of another of them or of the depth image; that is not checked, as rows may be interleaved. */
typedef struct sphc_aligned {
  uint32_t struct_size;
  uint32_t depth_stride_bytes, mask_stride_bytes, confidence_stride_bytes; /* from a row to the next */
  uint16_t *depth; /* z in the colour camera's frame, in aligned_unit_m; 0: none */
  uint8_t *mask;   /* SPHC_ALIGNED_ values */
  /* 255 / (1 + (e / 0.01)^2), rounded, for a depth of relative error e, 1 sigma: 255 exact, 128 an error of 1 %, 51
   * of 2 %; 0 where there is no depth.  e has the noise of the sensor, and the slope of the surface times how far
   * beside it was measured: 0.3 px of the depth image if MEASURED, 0.8 px if FILLED; a neighbour that is missing
   * or on another surface counts as a slope of 10 % a pixel. */
  uint8_t *confidence;
} sphc_aligned;

typedef struct sphc_aligner sphc_aligner;
/* Defaults: those of sphc_localizer_config_init; the cameras stay zero: set the rig.  SPHC_E_STRUCT_SIZE when the
 * size is none that the struct ever had. [pure] */
SPHC_API sphc_status sphc_aligner_config_init(sphc_aligner_config *config, size_t struct_size);
/* What sphc_aligner_init will need for this config: about 10 bytes a pixel of the depth image (2 where its camera
 * is a PINHOLE) and 8 a pixel of the colour image. Errors: ARGUMENT, STRUCT_SIZE. [pure] */
SPHC_API sphc_status sphc_aligner_memory(const sphc_aligner_config *config, sphc_memory *memory,
                                         sphc_message *message);
/* Upper bound of its state_bytes for any library of this ABI, for memory that is not asked for. */
#define SPHC_ALIGNER_BYTES_MAX(depth_width, depth_height, color_width, color_height) \
  (UINT64_C(65536) + UINT64_C(16) * ((depth_width) + 64) * ((depth_height) + 16) +   \
   UINT64_C(10) * ((color_width) + 64) * ((color_height) + 16))
/* Makes an aligner in caller memory, borrowed until sphc_aligner_fini; `config` is copied.  Computes a ray for
 * every pixel, which takes as long as some dozen frames.  Errors: ARGUMENT, STRUCT_SIZE, MEMORY_SIZE,
 * MEMORY_ALIGNMENT. [pure] */
SPHC_API sphc_status sphc_aligner_init(void *memory, size_t memory_bytes, const sphc_aligner_config *config,
                                       sphc_aligner **aligner, sphc_message *message);
/* Aligns one depth image (config.depth_format, the size in config.rig.depth_camera; borrowed).  Set
 * aligned->struct_size first. The same image gives the same bytes on every machine.  Failures: ARGUMENT,
 * STRUCT_SIZE, IMAGE (sphc_aligner_message explains); the aligner can go on with the next image.  Bounded time, no
 * allocation, no OS call. [exclusive] */
SPHC_API sphc_status sphc_aligner_process(sphc_aligner *aligner, const sphc_image *depth,
                                          const sphc_aligned *aligned);
/* Text about the last failure of sphc_aligner_process on this instance, "" if it did not fail; owned by the
 * instance, valid until its next call. [exclusive] */
SPHC_API const char *sphc_aligner_message(const sphc_aligner *aligner);
/* Accepts null and pointer to null; sets *aligner to null; frees nothing. [exclusive] */
SPHC_API void sphc_aligner_fini(sphc_aligner **aligner);

/* ---- localizer ---- */

typedef int32_t sphc_log_level;
enum { SPHC_LOG_ERROR = 1, SPHC_LOG_WARNING = 2, SPHC_LOG_INFO = 3, SPHC_LOG_DEBUG = 4 };
SPHC_API const char *sphc_log_level_name(sphc_log_level level); /* [pure] */
/* Called on the calling thread only; `text` is terminated and borrowed for the call. */
typedef void (*sphc_log_fn)(void *user, sphc_log_level level, const char *text, size_t length);
/* Monotonic clock in nanoseconds, from the caller: the library makes no OS call. */
typedef int64_t (*sphc_clock_fn)(void *user);
/* A piece of a frame's work, for sphc_parallel_fn: nothing is known of the thread that it runs on. */
typedef void (*sphc_task_fn)(void *task_data, uint32_t index);
/* Threads of the caller's: calls task(task_data, i) once for every i from 0 to count - 1, in any order, at the same
 * time as far as it has threads for it, and returns when all have ended. */
typedef void (*sphc_parallel_fn)(void *user, uint32_t count, sphc_task_fn task, void *task_data);
#define SPHC_PARALLEL_MAX 8u /* pieces of a frame's work */

/* Whether frames belong together. */
typedef int32_t sphc_localizer_mode;
enum {
  SPHC_MODE_TRACKING = 0, /* frames follow each other: the last pose says where to look; see sphc_localizer_state */
  SPHC_MODE_SINGLE = 1    /* each frame is looked at alone (what is learnt of the depth sensor stays) */
};
SPHC_API const char *sphc_localizer_mode_name(sphc_localizer_mode mode); /* [pure] */

/* How far the last pose is to be trusted, after a frame; docs/localizer.md draws the transitions. */
typedef int32_t sphc_localizer_state;
enum {
  SPHC_STATE_RELOCALIZING = 0, /* no pose is trusted; always so in SPHC_MODE_SINGLE */
  SPHC_STATE_TRACKING = 1,     /* poses agree, one of them was sure (over 0.95), and no fault doubts this one */
  SPHC_STATE_LOST = 2          /* was tracking, and no pose came, another, or a doubted one; for 1 s at most */
};
SPHC_API const char *sphc_localizer_state_name(sphc_localizer_state state); /* [pure] */

/* A camera of a rig beside the colour camera: grey or colour, of any model and size, looking anywhere. */
typedef struct sphc_localizer_camera {
  uint32_t struct_size;
  uint32_t reserved;
  sphc_camera camera;
  sphc_rigid color_from_camera; /* within the limits of sphc_rig.color_from_depth */
  int64_t row_time_ns;          /* as config.color_row_time_ns */
} sphc_localizer_camera;
#define SPHC_CAMERAS_MAX 8u          /* of a rig, the colour camera among them */
#define SPHC_ROW_TIME_MAX_NS 1000000 /* either sign */

/* A depth camera of a rig beside the one in config.rig. */
typedef struct sphc_localizer_depth_camera {
  uint32_t struct_size;
  sphc_format format; /* as config.depth_format */
  sphc_camera camera;
  sphc_rigid color_from_depth;  /* within the limits of sphc_rig.color_from_depth */
  double unit_m;                /* metres per unit of the depth image */
  double min_m, max_m;          /* measurements outside are ignored */
  double sigma_m, sigma_per_m2; /* noise, as config.depth_sigma_m */
  /* How it is off against the depth camera in config.rig: z of that one = z + offset + slope (z - depth_mid_m).  1
   * sigma of what is unknown of it before the first frame; it is learnt where both measure what the colour camera
   * sees.  Both 0: they measure alike. */
  double offset_sigma_m, slope_sigma;
  uint32_t amplitude_min; /* as config.amplitude_min, of its own amplitudes */
  uint32_t reserved;
} sphc_localizer_depth_camera;
#define SPHC_DEPTH_CAMERAS_MAX 2u /* of a rig, the one in config.rig among them */

typedef struct sphc_localizer_config {
  uint32_t struct_size;
  uint32_t max_keypoints; /* of all cameras together; strongest are kept; 64 to 4096; default 800 */
  uint32_t max_maps;      /* that it has at once; 1 to SPHC_MAPS_MAX; default 16 */
  sphc_localizer_mode mode;
  uint64_t seed; /* same seed, maps, config and frames: same bytes in the results */

  sphc_rig rig;

  /* Measurements outside are ignored; 0.01 to 100, and 0.01 more to 200, at most 65535 units of the rig, to which
   * metres are rounded too; default 0.25 and 6. */
  double depth_min_m, depth_max_m;
  /* Noise of the depth sensor, 1 sigma: sigma(z) = depth_sigma_m + depth_sigma_per_m2 z^2; 1e-5 to 1 and 0 to 1;
   * default 0.004 and 0.002. */
  double depth_sigma_m, depth_sigma_per_m2;
  double pixel_sigma_px; /* noise of a keypoint's position, 1 sigma; 0.01 to 20; default 0.8 */
  double map_sigma_m;    /* error of a map point across its direction, 1 sigma; 0 to 1; default 0.004 */

  /* Bias of the depth sensor, which the localizer learns from frame to frame: true z = z + offset + slope (z -
   * mid). 1 sigma of what is unknown of it before the first frame; both 0: no bias, and nothing is learnt.
   * A common scale of depths cannot be observed, so the offset's sigma at mid range should be small.  1e-6 to 1 and
   * to 0.5; default 0.003 and 0.02. */
  double depth_mid_m; /* 0 to 200; 0, the default: the geometric mean of depth_min_m and depth_max_m */
  double depth_offset_sigma_m, depth_slope_sigma;

  sphc_log_fn log; /* may be null */
  void *log_user;
  /* What says more is not made.  SPHC_LOG_WARNING has a line for each fault when a frame has it for the first time,
   * for a localizer without a map, for times of depth and colour that are more than 1 s apart, and for times of
   * frames that do not grow; SPHC_LOG_DEBUG one for every frame; the others none yet.  Not looked at where log is
   * null. */
  sphc_log_level log_level; /* default SPHC_LOG_INFO */
  uint32_t reserved;
  sphc_clock_fn clock; /* may be null: stage times are then 0, and no frame has a deadline */
  void *clock_user;

  sphc_format depth_format; /* of frame.depth, a DEPTH or RANGE format; 0: SPHC_FORMAT_DEPTH16 */
  /* Measurements whose pixel in frame.amplitude is below this are ignored, and so are those between two surfaces
   * (flying pixels).  0: frame.amplitude is not looked at. */
  uint32_t amplitude_min;
  sphc_band color_band; /* what the cameras see; maps of another band are refused */
  uint32_t reserved2;

  /* The further cameras of the rig: an array, borrowed until the call returns, whose elements have the struct_size
   * of the first and lie so far apart.  What they see joins what the colour camera sees, with depth where the depth
   * camera sees it too, else as rays.  docs/localizer.md. */
  const sphc_localizer_camera *cameras; /* null where there are none */
  uint32_t camera_count;                /* 0 to SPHC_CAMERAS_MAX - 1 */
  uint32_t reserved3;
  /* Of a rolling shutter: from a row's exposure to that of the row below it.  In SPHC_MODE_TRACKING rows are taken
   * to the time of the middle one, which is the image's, by odometry, or else by how the camera moved from pose to
   * pose.  In both modes a pose is less sure by what is not known of that motion.  0: all at once. */
  int64_t color_row_time_ns;

  /* Lets a frame use several cores; the same bytes in the results whatever it does, where no deadline is set. null:
   * the calling thread does all.  Called one to a few dozen times a frame, on the thread of the call, and where
   * sphc_localizer_extract runs beside another call, by both at the same time.  Its tasks read config.clock where
   * the frame has a deadline, so the clock must bear several threads; nothing else of the caller's is called. */
  sphc_parallel_fn parallel;
  void *parallel_user;
  /* Pieces that its work is cut into at most: as many as there are threads for it, 1 to SPHC_PARALLEL_MAX; each
   * more than one needs memory.  0 where parallel is null. */
  uint32_t parallel_tasks;
  uint32_t reserved4;

  /* The further depth camera of the rig: an array as `cameras` is.  Where both measure a keypoint's depth, the one
   * that is surer of it counts.  docs/localizer.md. */
  const sphc_localizer_depth_camera *depth_cameras; /* null where there is none */
  uint32_t depth_camera_count;                      /* 0 to SPHC_DEPTH_CAMERAS_MAX - 1 */
  uint32_t reserved5;
} sphc_localizer_config;

#define SPHC_POSE_MAX_OFFSET_M 1e4 /* of a part of the t_m of a pose, or of a map's transform, either sign */
#define SPHC_UP_MIN_LENGTH 1e-6    /* of up_camera and up_map */
#define SPHC_UP_MAX_LENGTH 1e6     /* the same */

/* What is known of a pose before its frame is looked at. */
enum { SPHC_PRIOR_POSE = 1u, SPHC_PRIOR_UP = 2u, SPHC_PRIOR_ODOMETRY = 4u };
typedef struct sphc_localizer_prior {
  uint32_t struct_size;
  uint32_t flags;  /* SPHC_PRIOR_ bits: which of the parts below count */
  uint32_t map_id; /* the map whose frame POSE and UP are in */
  uint32_t reserved;
  /* POSE: where the camera should be.  Only the map points that should be in view are looked at first; where that
   * fails, or the sigmas say too little, the whole of the maps. */
  sphc_rigid camera_from_map;
  double rotation_sigma_rad;  /* 1 sigma an axis; 1e-6 to 3.2 */
  double translation_sigma_m; /* 1 sigma an axis, of the camera's centre; 1e-6 to 1000 */
  /* UP: the vertical, from an inertial sensor.  Halves the size of a minimal sample and steadies the pose. */
  double up_camera[3], up_map[3]; /* the same direction in both frames; neither need be a unit vector */
  double up_sigma_rad;            /* 1 sigma an axis; 1e-4 to 0.5 */
  /* ODOMETRY: the device's own dead reckoning at color_time_ns, in a frame of its own that may drift.  Used in
   * SPHC_MODE_TRACKING, from frame to frame: it predicts better than constant velocity, lets frames that show too
   * little be put together, and takes depth and views to the time of the colour image (by the steps of the 32
   * frames before, at most 0.5 s; each step 0.25 s or less).  Its frame may change: a step beyond what a head does
   * (3.5 m/s, 5 rad/s, and 5 sigma) is left out. */
  sphc_rigid odometry_from_camera;
  double odometry_rotation_sigma_rad;  /* 1 sigma an axis, of the step from the frame before; 1e-6 to 1 */
  double odometry_translation_sigma_m; /* the same; 1e-6 to 10 */
} sphc_localizer_prior;

/* The image of a further camera; everything is borrowed. */
typedef struct sphc_localizer_view {
  uint32_t struct_size;
  uint32_t reserved;
  int64_t time_ns;  /* mid-exposure, as depth_time_ns of a frame */
  sphc_image image; /* any format that is not of depth; data null: the camera has none in this frame */
  /* As they are in this frame, with heat or focus; null: as in the config.  The size stays. */
  const sphc_camera *camera;
  const sphc_rigid *color_from_camera;
} sphc_localizer_view;

/* The image of a further depth camera; everything is borrowed. */
typedef struct sphc_localizer_depth_view {
  uint32_t struct_size;
  uint32_t reserved;
  int64_t time_ns;      /* mid-exposure, as depth_time_ns of a frame */
  sphc_image depth;     /* of the camera's format and size; data null: the camera has none in this frame */
  sphc_image amplitude; /* as frame.amplitude; with every depth image where the camera's amplitude_min is set */
  /* As they are in this frame, with heat or focus; null: as in the config.  The size stays. */
  const sphc_camera *camera;
  const sphc_rigid *color_from_depth;
} sphc_localizer_depth_view;

/* A colour and a depth image taken at about the same time; everything is borrowed. */
typedef struct sphc_localizer_frame {
  uint32_t struct_size;
  uint32_t sequence;     /* the caller's own number; comes back in the result */
  int64_t color_time_ns; /* mid-exposure; the pose is that of the colour camera at this time */
  /* The same, on the same clock.  Where the two differ, odometry takes depth to the time of the colour image, and
   * without it the covariance and the confidence know that the camera may have moved. */
  int64_t depth_time_ns;
  sphc_image color;                  /* any format that is not of depth; the size in config.rig.color_camera */
  sphc_image depth;                  /* config.depth_format; the size in config.rig.depth_camera */
  const sphc_localizer_prior *prior; /* null: nothing is known but what earlier frames told */
  /* The frame is to be answered so long after the call began, with the best pose so far; 0: no deadline.  Needs
   * config.clock, and counts in its time.  result.cuts says what was left out for it; docs/localizer.md. */
  uint32_t deadline_us;
  uint32_t reserved;
  uint64_t reserved2; /* 0; puts what follows behind the struct's first version on machines of 32 bits too */
  /* How much of its own light the depth sensor saw in each pixel, or how sure it is of it: GRAY8, GRAY10, GRAY12 or
   * GRAY16; the depth image's size.  Every frame has one where config.amplitude_min is set, which says what is
   * believed; else it is not looked at. */
  sphc_image amplitude;
  /* Of each of config.cameras one, in their order: an array whose elements have the struct_size of the first and
   * lie so far apart.  Null where the config has no cameras. */
  const sphc_localizer_view *views;
  uint32_t view_count; /* config.camera_count */
  uint32_t reserved3;
  /* As they are in this frame, with heat or focus; null: as in config.rig.  The size stays. */
  const sphc_camera *color_camera;
  const sphc_rigid *color_from_depth;
  /* The same; of a RANGE format, cosines stay those of config.rig.depth_camera. */
  const sphc_camera *depth_camera;
  /* Of each of config.depth_cameras one, as `views` are of cameras.  Null where the config has none. */
  const sphc_localizer_depth_view *depth_views;
  uint32_t depth_view_count; /* config.depth_camera_count */
  uint32_t reserved4;
} sphc_localizer_frame;

typedef int32_t sphc_localizer_outcome;
enum {
  SPHC_OUTCOME_LOCALIZED = 0,
  SPHC_OUTCOME_FEW_KEYPOINTS = 1, /* too few keypoints: dark, blurred or blank image */
  SPHC_OUTCOME_FEW_DEPTHS = 2,    /* too few keypoints with depth: sensor blind, or calibration wrong */
  SPHC_OUTCOME_FEW_MATCHES = 3,   /* too few look like anything in the map: another place, or much changed */
  SPHC_OUTCOME_NO_CONSENSUS = 4,  /* no pose agrees with clearly more matches than chance would */
  SPHC_OUTCOME_UNCERTAIN = 5,     /* a pose was found, but weakly, unconfirmed, or beside another that fits too */
  SPHC_OUTCOME_DEADLINE = 6,      /* no pose before frame.deadline_us; result.cuts says what was left out */
  SPHC_OUTCOME_CONTRADICTION = 7  /* the frame contradicts itself, and no pose is given; result.faults says how */
};
SPHC_API const char *sphc_localizer_outcome_name(sphc_localizer_outcome outcome); /* [pure] */

/* What is wrong with a frame or with what it was told, as far as that shows; bits of result.faults.  Those before
 * DEPTH_SCALE, MIRRORED and DISTANCES_DISAGREE take the pose away (SPHC_OUTCOME_CONTRADICTION).  Frames are
 * compared with earlier ones in SPHC_MODE_TRACKING.  docs/consistency.md has causes and cures. */
enum {
  SPHC_FAULT_DEPTH_RANGE = 1u,    /* depth is measured, but nearly none between depth_min_m and depth_max_m */
  SPHC_FAULT_DEPTH_CONSTANT = 2u, /* one depth everywhere */
  SPHC_FAULT_DEPTH_BENT = 4u,     /* planes are bent: inverted depth, or disparity in its place */
  SPHC_FAULT_DEPTH_FROZEN = 8u,   /* the same depth image again while the colour image moves */
  SPHC_FAULT_COLOR_FROZEN = 16u,  /* the same colour image again while depth moves */
  SPHC_FAULT_DEPTH_COLOR_DISAGREE = 32u, /* edges of depth are not where the image has edges: late or mirrored
                                           depth, another calibration, an image that was cropped or scaled */
  SPHC_FAULT_DEPTH_SCALE = 64u,          /* poses go farther, or less far, than odometry; confidence is below 0.5 */
  SPHC_FAULT_DEPTH_BIAS = 128u, /* result.depth is beyond 2.5 of the config's sigmas; confidence is below 0.5 */
  SPHC_FAULT_VERTICAL_DISAGREES = 256u, /* UP is not the pose's vertical; the pose was found without it */
  SPHC_FAULT_MIRRORED = 512u, /* left and right are changed against the map: a mirror, or an image that is turned
                                over; no pose is given */
  SPHC_FAULT_DISTANCES_DISAGREE = 1024u, /* points of the map lie elsewhere than earlier frames said: what is given
                                            as depth, a calibration, or a place that looks like another; no pose */
  SPHC_FAULT_ODOMETRY_DISAGREES = 2048u, /* ODOMETRY moves otherwise than poses do: other axes, an inverse, or it
                                            stands still; it is left out, and poses are found without it */
  SPHC_FAULT_FOCAL_DISAGREES = 4096u     /* the matches agree with another focal length: an image that was cropped
                                            or scaled, another calibration, no depth; confidence is at most 0.5 */
};
SPHC_API const char *sphc_localizer_fault_name(uint32_t fault); /* [pure] */

/* What was left out of a frame for its deadline, bits of result.cuts: more time might have found a pose, or a
 * better one. */
enum {
  SPHC_CUT_FEATURES = 1u, /* fine scales of the image, or the weakest keypoints */
  SPHC_CUT_MATCHES = 2u,  /* keypoints, of which some were not compared with the map */
  SPHC_CUT_SEARCH = 4u,   /* samples, or searches that might have followed */
  SPHC_CUT_VERIFICATION =
      8u /* steps that refine, challenge or confirm a pose; what they must confirm is UNCERTAIN */
};
SPHC_API const char *sphc_localizer_cut_name(uint32_t cut); /* [pure] */

/* Why no pose was found, as far as that shows, for the person who wears the cameras; bits of result.hints.  Set
 * only where there is no pose; several may be set; none where nothing is known.  Each is of this frame alone, so a
 * program says one aloud when it has come for some frames in a row.  docs/hints.md. */
enum {
  SPHC_HINT_TOO_DARK = 1u,          /* the image's noise is not far below its light: "more light" */
  SPHC_HINT_TOO_FAST = 2u,          /* the image is blurred along a line: "move slower" */
  SPHC_HINT_TOO_PLAIN = 4u,         /* little stands out in a bright and sharp image: "look elsewhere" */
  SPHC_HINT_NO_DEPTH_IN_RANGE = 8u, /* few keypoints have depth: "step back, or closer; glass has no depth" */
  SPHC_HINT_NOT_IN_MAP = 16u,       /* the image shows enough, but not what the map shows: "you are elsewhere" */
  SPHC_HINT_AMBIGUOUS = 32u         /* UNCERTAIN: another pose fits nearly as well, or the one that was found
                                     * jumps from the track, or the whole map denies it: "look around" */
};
SPHC_API const char *sphc_localizer_hint_name(uint32_t hint); /* [pure] */

/* What a pose does to a world that was drawn by earlier ones; bits of result.events.  None where there is no pose,
 * where it is where earlier frames and odometry let it be expected, and in SPHC_MODE_SINGLE. */
enum {
  SPHC_EVENT_RELOCALIZED = 1u, /* nothing was expected: the first pose, or the first after 1 s without (10 s with
                                * odometry) */
  SPHC_EVENT_JUMPED = 2u,      /* elsewhere than expected, by more than 5 sigma; result.jump_m and jump_rad */
  SPHC_EVENT_MAP_CHANGED = 4u  /* in another map than the one expected; how far that is can be said where both have
                                  transforms */
};
SPHC_API const char *sphc_localizer_event_name(uint32_t event); /* [pure] */

/* How the depth sensor is off, as learnt up to this frame: true z = z + offset_m + slope (z - mid_m), and its noise
 * is noise_scale times the one in the config. */
typedef struct sphc_depth_bias {
  double mid_m, offset_m, slope;
  double offset_sigma_m, slope_sigma; /* 1 sigma */
  double correlation;                 /* of offset and slope */
  double noise_scale;
} sphc_depth_bias;

typedef struct sphc_localizer_result {
  uint32_t struct_size;
  uint32_t sequence; /* of the frame */
  int64_t time_ns;   /* frame.color_time_ns */
  sphc_localizer_outcome outcome;
  uint32_t keypoints;  /* found in the colour image */
  uint32_t lifted;     /* of these, with depth */
  uint32_t matches;    /* keypoints with a map point that passed the ratio test, lifted or not */
  uint32_t inliers;    /* lifted and agreeing with the pose: of these, and where frames > 1 of earlier ones */
  uint32_t iterations; /* minimal samples drawn, in all searches */
  sphc_rigid camera_from_map; /* valid when outcome is LOCALIZED, else identity */
  /* Row-major 6 x 6 covariance of (rotation vector rad, translation m), both in the camera frame, for a
   * perturbation applied on the left: T = exp(xi) T_estimate.  Zeros unless LOCALIZED. */
  double covariance[36];
  /* Time of each stage by config.clock: 0 where that stepped back, and 4294967295 at most. */
  uint32_t features_us, align_us, match_us, pose_us;
  double confidence; /* probability that the pose is within 5 cm and 5 degrees; 0 unless LOCALIZED; for other
                      * bounds sphc_localizer_result_confidence */
  uint32_t cuts;     /* SPHC_CUT_ bits; 0: nothing was left out */
  sphc_localizer_state state; /* after this frame */
  uint32_t map_id;            /* of the map that camera_from_map is in; where there is no pose, the likeliest, or
                               * SPHC_MAP_NONE */
  uint32_t frames;       /* whose matches the pose was found from: 1, or more where odometry put some together */
  uint32_t guided;       /* 1: found where it was expected, without a search of the whole map */
  uint32_t faults;       /* SPHC_FAULT_ bits; 0: nothing was found */
  sphc_depth_bias depth; /* what the frame was looked at with */
  uint32_t hints;        /* SPHC_HINT_ bits: why there is no pose; 0 where there is one */
  uint32_t events;       /* SPHC_EVENT_ bits: what the pose does to a world drawn by earlier ones */
  /* How far the pose is from the one that was expected at time_ns before the frame was looked at: the camera's
   * centre, and its angle.  So far does a world jump that is drawn by sphc_localizer_predict.  Small where no event
   * says otherwise; 0 where nothing was expected, or in another map without transforms. */
  double jump_m, jump_rad;
} sphc_localizer_result;

/* Fills *config with defaults for its first struct_size bytes and sets struct_size; the cameras stay zero: set
 * the rig.  SPHC_E_STRUCT_SIZE when the size is none that the struct ever had. [pure] */
SPHC_API sphc_status sphc_localizer_config_init(sphc_localizer_config *config, size_t struct_size);

/* Results and inputs that say nothing yet: zero but for struct_size and identity poses.  A call that fails leaves
 * its result as it was, so ask what the call returned before the outcome, which is LOCALIZED here.  STRUCT_SIZE as
 * above. [pure] */
SPHC_API sphc_status sphc_localizer_result_init(sphc_localizer_result *result, size_t struct_size);
SPHC_API sphc_status sphc_localizer_frame_init(sphc_localizer_frame *frame, size_t struct_size);
SPHC_API sphc_status sphc_localizer_prior_init(sphc_localizer_prior *prior, size_t struct_size);
SPHC_API sphc_status sphc_localizer_camera_init(sphc_localizer_camera *camera, size_t struct_size);
SPHC_API sphc_status sphc_localizer_view_init(sphc_localizer_view *view, size_t struct_size);
/* Of the depth camera, the defaults of config for range, noise and bias too, and millimetres. [pure] */
SPHC_API sphc_status sphc_localizer_depth_camera_init(sphc_localizer_depth_camera *camera, size_t struct_size);
SPHC_API sphc_status sphc_localizer_depth_view_init(sphc_localizer_depth_view *view, size_t struct_size);

/* What sphc_localizer_init will need for this config. Errors: ARGUMENT, STRUCT_SIZE. [pure] */
SPHC_API sphc_status sphc_localizer_memory(const sphc_localizer_config *config, sphc_memory *memory,
                                           sphc_message *message);
/* Upper bounds of it for any library of this ABI, for memory that is not asked for: buffers with an extent that the
 * compiler must know.  color_width x color_height is the colour camera's image; of a rig, the largest width and the
 * largest height of all cameras but the depth camera. */
#define SPHC_LOCALIZER_STATE_BYTES_MAX(max_keypoints, max_maps) \
  (UINT64_C(98304) + UINT64_C(160) * (max_keypoints) + UINT64_C(256) * (max_maps))
#define SPHC_LOCALIZER_SCRATCH_BYTES_MAX(max_keypoints, color_width, color_height) \
  (UINT64_C(4194304) + UINT64_C(2048) * (max_keypoints) +                          \
   UINT64_C(512) * ((color_width) + UINT64_C(1) * (color_height)) + UINT64_C(10) * (color_width) * (color_height))
/* What is added to each of the two where config.depth_format is not SPHC_FORMAT_DEPTH16 or config.amplitude_min is
 * set; depth_width x depth_height is the depth camera's image. */
#define SPHC_LOCALIZER_DEPTH_BYTES_MAX(depth_width, depth_height) \
  (UINT64_C(65536) + UINT64_C(2) * (depth_width) * (depth_height))
/* What is added to each of the two where config.camera_count is not 0; of width and height again the largest. */
#define SPHC_LOCALIZER_CAMERAS_BYTES_MAX(max_keypoints, width, height) \
  (UINT64_C(65536) + UINT64_C(256) * (max_keypoints) + UINT64_C(1) * (width) * (height))
/* What is added to each of the two for every one of config.depth_cameras, beside what its own format and
 * amplitude_min add by SPHC_LOCALIZER_DEPTH_BYTES_MAX. */
#define SPHC_LOCALIZER_DEPTH_CAMERA_BYTES_MAX(depth_width, depth_height) \
  (UINT64_C(65536) + UINT64_C(1) * (depth_width) * (depth_height))
/* What is added to the scratch where config.parallel_tasks is more than 1. */
#define SPHC_LOCALIZER_PARALLEL_BYTES_MAX(max_keypoints, color_width, parallel_tasks) \
  (UINT64_C(1) * (parallel_tasks) *                                                   \
   (UINT64_C(65536) + UINT64_C(128) * (max_keypoints) + UINT64_C(1024) * (color_width)))

/* One named piece of the memory, for an account of its bytes: `index` from 0 until SPHC_END.  `name` is static
 * storage. [pure] */
typedef struct sphc_memory_piece {
  const char *name; /* "features.pyramid" */
  uint64_t bytes;
  uint32_t scratch; /* 1: in scratch, 0: in state */
  uint32_t reserved;
} sphc_memory_piece;
SPHC_API sphc_status sphc_localizer_memory_piece(const sphc_localizer_config *config, uint32_t index,
                                                 sphc_memory_piece *piece);

typedef struct sphc_localizer sphc_localizer;

#define SPHC_MAPS_MAX 64u         /* maps of one localizer */
#define SPHC_MAP_NONE 0xFFFFFFFFu /* no map's id */

/* Makes a localizer in caller memory; it has no map yet.  `config` is copied; `state` and `scratch` are borrowed
 * until sphc_localizer_fini and must not overlap.  Errors: ARGUMENT, STRUCT_SIZE, MEMORY_SIZE, MEMORY_ALIGNMENT.
 * [pure] */
SPHC_API sphc_status sphc_localizer_init(void *state, size_t state_bytes, void *scratch, size_t scratch_bytes,
                                         const sphc_localizer_config *config, sphc_localizer **localizer,
                                         sphc_message *message);
/* Accepts null and pointer to null; sets *localizer to null; frees nothing. [exclusive] */
SPHC_API void sphc_localizer_fini(sphc_localizer **localizer);

/* Gives the localizer a map (a room), under an id of the caller's; with several it finds out which one a frame
 * shows, and each has a frame of its own.  Where it has a map of this id already, that one is replaced: by a newer
 * release of the same place, whose frame is the same, so tracking goes on.  Between any two frames.  The map is
 * borrowed until it is replaced or removed, or until sphc_localizer_fini; it must not overlap the localizer's
 * memory.  Failures: ARGUMENT: its band is not config.color_band, among others; CAPACITY: config.max_maps are there
 * (sphc_localizer_message explains). [exclusive] */
SPHC_API sphc_status sphc_localizer_set_map(sphc_localizer *localizer, uint32_t map_id, const sphc_map *map);
/* Takes a map away; what was tracked in it is forgotten, what was tracked in another is not.  ARGUMENT when there
 * is none of this id. [exclusive] */
SPHC_API sphc_status sphc_localizer_remove_map(sphc_localizer *localizer, uint32_t map_id);
/* Where a map lies in a frame that several maps share, such as a building's: x_common = R x_map + t, with its
 * errors, 1 sigma an axis (0 to 0.5 rad about the map's origin, 0 to 100 m).  A camera that leaves a map is then
 * expected in the others that have one: it is searched for there, stays tracked, and result.jump_m is measured
 * across.  Poses stay in the frames of their maps, and a newer release of the map keeps its transform.  null: there
 * is none, as at first. Failures: ARGUMENT (sphc_localizer_message explains). [exclusive] */
SPHC_API sphc_status sphc_localizer_set_map_transform(sphc_localizer *localizer, uint32_t map_id,
                                                      const sphc_rigid *common_from_map, double rotation_sigma_rad,
                                                      double translation_sigma_m);
/* How many maps it has. [exclusive] */
SPHC_API uint32_t sphc_localizer_map_count(const sphc_localizer *localizer);

/* How the search goes: for those who measure.  Ids are never renumbered or reused; one whose method a newer library
 * no longer has is SPHC_E_UNSUPPORTED there. */
typedef int32_t sphc_localizer_parameter;
enum {
  SPHC_PARAMETER_MAX_RATIO = 1, /* Lowe's ratio test, on distances */
  SPHC_PARAMETER_PROBES = 2,    /* cells of a map's index searched for each keypoint: more cost time and find more;
                                   0: all of the map */
  SPHC_PARAMETER_MAX_ITERATIONS = 3, /* minimal samples drawn in one search, at most; a frame takes one to a few */
  SPHC_PARAMETER_MIN_INLIERS = 4     /* a pose with fewer is not given out */
};
SPHC_API const char *sphc_localizer_parameter_name(sphc_localizer_parameter parameter); /* [pure] */
/* What a parameter is where it was not set, and may be set to. */
typedef struct sphc_localizer_parameter_range {
  uint32_t struct_size;
  uint32_t whole; /* 1: only whole numbers are taken */
  double initial, lowest, highest;
} sphc_localizer_parameter_range;
/* Set range->struct_size first.  UNSUPPORTED for an id that this library does not know. [pure] */
SPHC_API sphc_status sphc_localizer_get_parameter_range(sphc_localizer_parameter parameter,
                                                        sphc_localizer_parameter_range *range);
/* From the next frame on.  Failures: ARGUMENT: out of range; UNSUPPORTED (sphc_localizer_message explains).
 * [exclusive] */
SPHC_API sphc_status sphc_localizer_set_parameter(sphc_localizer *localizer, sphc_localizer_parameter parameter,
                                                  double value);
SPHC_API sphc_status sphc_localizer_get_parameter(const sphc_localizer *localizer,
                                                  sphc_localizer_parameter parameter,
                                                  double *value); /* [exclusive] */

/* What is known of the depth sensor from before, such as result.depth of the last frame before the power was cut;
 * learning goes on from there.  ARGUMENT where it cannot be one of this config: not finite, vaguer than
 * config.depth_offset_sigma_m or depth_slope_sigma, another mid range (sphc_localizer_message explains).
 * [exclusive] */
SPHC_API sphc_status sphc_localizer_set_depth_bias(sphc_localizer *localizer, const sphc_depth_bias *depth);

/* Forgets where the camera was, as after a long pause; what was learnt of the depth sensor stays. [exclusive] */
SPHC_API void sphc_localizer_reset(sphc_localizer *localizer);

/* Where was the colour camera?  In SPHC_MODE_TRACKING frames come in the order of color_time_ns; a time that does
 * not grow, or a gap of more than 1 s, starts anew.  Set result->struct_size first.  SPHC_OK: localized, *result
 * filled. SPHC_NOT_LOCALIZED: *result filled but for the pose; result->outcome says why.  Failures: ARGUMENT,
 * STRUCT_SIZE, IMAGE (sphc_localizer_message explains); the localizer can go on with the next frame. Bounded time,
 * by frame.deadline_us too; no allocation, no OS call. [exclusive] */
SPHC_API sphc_status sphc_localizer_process(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                                            sphc_localizer_result *result);

/* Text about the failure of the last call on this instance that can fail, "" if it did not; owned by the instance,
 * always at the same place, until its next call.  ASCII.  Calls that take a const localizer leave it as it was, and
 * sphc_localizer_extract has sphc_features_message. [exclusive] */
SPHC_API const char *sphc_localizer_message(const sphc_localizer *localizer);

/* The probability that the camera is within so many metres and radians of the pose.  0 where there is no pose, for
 * a bound that is not above 0, and for a null result or one that nothing was written to.  Of the result, outcome
 * and covariance are read; docs/confidence.md. [pure] */
SPHC_API double sphc_localizer_result_confidence(const sphc_localizer_result *result, double translation_m,
                                                 double rotation_rad);

/* Where the colour camera is at a time of the caller's, such as when a display lights up. */
typedef struct sphc_localizer_prediction {
  uint32_t struct_size;
  uint32_t map_id;               /* of the map that camera_from_map is in; SPHC_MAP_NONE where nothing is known */
  int64_t time_ns;               /* that was asked for */
  int64_t pose_time_ns;          /* of the frame whose pose this one comes from */
  sphc_localizer_state state;    /* after the last frame */
  uint32_t reserved;             /* 0 */
  sphc_rigid camera_from_map;    /* identity where nothing is known, and zeros in all that follows */
  double covariance[36];         /* as result.covariance; grows with the time since the frame */
  double velocity_in_map_m_s[3]; /* of the camera's centre, along the map's axes */
  double angular_velocity_in_map_rad_s[3];                 /* of the camera, about the map's axes, right-handed */
  double velocity_sigma_m_s, angular_velocity_sigma_rad_s; /* 1 sigma an axis; where no step is known the velocities
                                                            * are 0, and these those of heads */
} sphc_localizer_prediction;
/* Zero but for struct_size, map_id and the identity pose.  STRUCT_SIZE as above. [pure] */
SPHC_API sphc_status sphc_localizer_prediction_init(sphc_localizer_prediction *prediction, size_t struct_size);
/* The pose at time_ns, in the time of frames: after the last pose, or up to 100 ms before it (where odometry goes
 * on from it: before the last frame).  From the last pose, and from there on by the rate of the caller's odometry,
 * or else at constant velocity; the covariance has the errors of both, and how heads accelerate (1 sigma: 4 m/s^2,
 * 6 rad/s^2).  Set prediction->struct_size first.  NOT_LOCALIZED, *prediction filled but for the pose: no pose
 * within the second before time_ns; time_ns too long before it; SPHC_MODE_SINGLE.  Failures: ARGUMENT, STRUCT_SIZE.
 * Changes nothing. [exclusive] */
SPHC_API sphc_status sphc_localizer_predict(const sphc_localizer *localizer, int64_t time_ns,
                                            sphc_localizer_prediction *prediction);

/* What became of one keypoint of the last processed frame; for overlays and diagnosis. */
enum { SPHC_OBSERVATION_LIFTED = 1u, SPHC_OBSERVATION_MATCHED = 2u, SPHC_OBSERVATION_INLIER = 4u };
typedef struct sphc_localizer_observation {
  float x_px, y_px;     /* in the image of its camera */
  float scale_px;       /* standard deviation of the Gaussian it was found at */
  float depth_m;        /* z in that camera; 0 unless LIFTED */
  uint32_t point_index; /* of the matched map point, of the map that result.map_id names; valid when MATCHED */
  uint32_t flags;       /* SPHC_OBSERVATION_ bits */
  uint32_t camera;      /* 0: the colour camera; i: config.cameras[i - 1] */
} sphc_localizer_observation;
/* Copies up to `capacity` observations, one every stride_bytes, and sets *count to how many there are. stride_bytes
 * is sizeof(sphc_localizer_observation), by which the library knows which fields the caller has; ARGUMENT for one
 * that the struct never had.  Before the first frame *count is 0. [exclusive] */
SPHC_API sphc_status sphc_localizer_observations(const sphc_localizer *localizer,
                                                 sphc_localizer_observation *observations, uint32_t stride_bytes,
                                                 uint32_t capacity, uint32_t *count);

/* A pose that the last processed frame may have. */
typedef struct sphc_localizer_hypothesis {
  uint32_t map_id;
  sphc_localizer_outcome outcome; /* what the pose would be without the others: LOCALIZED or UNCERTAIN */
  uint32_t inliers;               /* as result.inliers */
  uint32_t is_result;             /* 1: this is result.camera_from_map; at most one is */
  sphc_rigid camera_from_map;
  double gain;       /* sum over its inliers of 1 - (squared residual / its limit): what poses are compared by */
  double log_chance; /* natural logarithm of a bound on the probability that chance agrees so well */
} sphc_localizer_hypothesis;
#define SPHC_HYPOTHESES_MAX 8u
/* Copies up to `capacity` hypotheses, one every stride_bytes, and sets *count to how many there are, at most
 * SPHC_HYPOTHESES_MAX: the poses that were looked at and that chance does not explain, each once (poses of a map
 * within 15 cm and 8 degrees are one), those of most gain first.  Where the outcome is UNCERTAIN and a hint says
 * AMBIGUOUS, a program that knows more than the frame shows can tell which is right; one that knows no more should
 * take none.  Not every pose that fits is looked at.  stride_bytes as of sphc_localizer_observations; before the
 * first frame *count is 0. [exclusive] */
SPHC_API sphc_status sphc_localizer_hypotheses(const sphc_localizer *localizer,
                                               sphc_localizer_hypothesis *hypotheses, uint32_t stride_bytes,
                                               uint32_t capacity, uint32_t *count);

/* ---- the two halves of a frame ---- */

/* sphc_localizer_process in two calls: sphc_localizer_extract finds the features of the colour image, and
 * sphc_localizer_locate does the rest.  While one thread locates a frame, another may extract the features of the
 * next; each of two such features is filled, located and filled again.  Features that other hardware has found,
 * such as a DSP or an NPU, come in by sphc_features_set.  docs/localizer.md. */
typedef struct sphc_features sphc_features;

/* Where a feature lies in the image of its camera, x right, y down. */
typedef struct sphc_keypoint {
  float x_px, y_px; /* 0 to the image's width and height */
  float scale_px;   /* standard deviation of the Gaussian at which it was found; above 0, 8192 at most */
  float angle_rad;  /* of the dominant gradient, from x to y; -7 to 7 */
  float response;   /* |difference of Gaussians| there, grey levels in [0, 1]; 0 to 1 */
} sphc_keypoint;

#define SPHC_DESCRIPTOR_BYTES 128u /* square roots of the normalised histogram, times 512, at most 255 */

/* Keypoints, the strongest response first, and the descriptor of each. */
typedef struct sphc_features_arrays {
  uint32_t struct_size;
  uint32_t extractor; /* that described them: sphc_extractor_id(), as that of all maps */
  uint32_t count;
  /* From one to the next, also where count is 0; at most SPHC_STRIDE_MAX_BYTES. */
  uint32_t keypoint_stride_bytes;   /* a multiple of 4, at least sizeof(sphc_keypoint) */
  uint32_t descriptor_stride_bytes; /* at least SPHC_DESCRIPTOR_BYTES */
  uint32_t reserved;
  const sphc_keypoint *keypoints; /* aligned to 4 bytes; may be null where count is 0, as may descriptors */
  const uint8_t *descriptors;
  const uint8_t *cameras; /* of each keypoint, a byte apart: 0 the colour camera, i config.cameras[i - 1]; null: all
                           * of the colour camera */
} sphc_features_arrays;

/* What sphc_features_init will need, for localizers of this config: 148 bytes a keypoint (149 where there are
 * further cameras) and one a pixel of the colour image. Errors: ARGUMENT, STRUCT_SIZE. [pure] */
SPHC_API sphc_status sphc_features_memory(const sphc_localizer_config *config, sphc_memory *memory,
                                          sphc_message *message);
/* Upper bound of its state_bytes for any library of this ABI, for memory that is not asked for. */
#define SPHC_FEATURES_BYTES_MAX(max_keypoints, color_width, color_height) \
  (UINT64_C(4096) + UINT64_C(192) * (max_keypoints) + UINT64_C(1) * (color_width) * (color_height))
/* Makes features, of no frame yet, in caller memory, borrowed until sphc_features_fini.  Of `config` the sizes of
 * the images and max_keypoints count.  Errors: ARGUMENT, STRUCT_SIZE, MEMORY_SIZE, MEMORY_ALIGNMENT. [pure]
 */
SPHC_API sphc_status sphc_features_init(void *memory, size_t memory_bytes, const sphc_localizer_config *config,
                                        sphc_features **features, sphc_message *message);
/* Puts features of other hardware in.  Of `frame` color and color_time_ns are read: faults and hints are found in
 * the image.  Image and arrays are copied.  Failures: ARGUMENT: a keypoint is not finite, beyond the limits or
 * stronger than the one before it; CAPACITY: more than max_keypoints; MAP_EXTRACTOR: of another extractor;
 * STRUCT_SIZE, IMAGE (sphc_features_message explains); the features stay what they were. [exclusive] */
SPHC_API sphc_status sphc_features_set(sphc_features *features, const sphc_localizer_frame *frame,
                                       const sphc_features_arrays *arrays);
/* Reads them out: *arrays point into the features' memory, borrowed until their next extract, set or fini.  Set
 * arrays->struct_size first.  STATE where they are of no frame yet. [shared] */
SPHC_API sphc_status sphc_features_get(const sphc_features *features, sphc_features_arrays *arrays);
/* Text about the failure of the last sphc_localizer_extract into these features, or sphc_features_set; "" if it did
 * not fail; owned by the features, valid until the next of these calls. [exclusive] */
SPHC_API const char *sphc_features_message(const sphc_features *features);
/* Accepts null and pointer to null; sets *features to null; frees nothing. [exclusive] */
SPHC_API void sphc_features_fini(sphc_features **features);

/* Fills the features by the images of a frame: color, views, color_time_ns and deadline_us of it are read, and the
 * deadline bounds this call alone.  The images may go afterwards.  Failures: ARGUMENT: the features were made for
 * another config, among others; STRUCT_SIZE, IMAGE (sphc_features_message explains); the features stay what they
 * were.  Bounded time, no allocation, no OS call.  Exclusive with sphc_localizer_process, _extract and _fini of
 * this localizer, and with all calls of these features; every other call on the localizer may run meanwhile in
 * another thread.  Both threads then call config.clock and config.parallel, and the localizer's scratch is no
 * other's. [exclusive] */
SPHC_API sphc_status sphc_localizer_extract(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                                            sphc_features *features);
/* As sphc_localizer_process, from the features of the frame on: frame.color and the images of its views are not
 * looked at.  The same result, to the last bit but for times, where no deadline is set; several localizers may
 * locate the same features at the same time.  result.features_us is how long extract took, 0 for features that were
 * set.  Failures: also ARGUMENT where the features have another color_time_ns than the frame, or were made for
 * another config, and STATE where they are of no frame yet (sphc_localizer_message explains). [exclusive] */
SPHC_API sphc_status sphc_localizer_locate(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                                           const sphc_features *features, sphc_localizer_result *result);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_SPHERECLOUD_H */
