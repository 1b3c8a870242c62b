#define SPHC_UNSTABLE 1 /* the clock mapper is */
#include "replay.h"

#include <spherecloud/spherecloud_capture.h>

#include "forget.h"
#include "line.h"

/* ---- what is seen ---- */

enum { COLOR_WIDTH = 320, COLOR_HEIGHT = 240, DEPTH_WIDTH = 200, DEPTH_HEIGHT = 160, MAX_KEYPOINTS = 400 };
const room_camera replay_color_camera = {COLOR_WIDTH, COLOR_HEIGHT, 250};
static const room_camera depth_camera = {DEPTH_WIDTH, DEPTH_HEIGHT, 140};
static const int32_t baseline_um = 40000; /* the depth camera, to the right */

const int32_t replay_centre_um[3] = {100000, -200000, 1200000};
const room_view replay_map_views[REPLAY_MAP_VIEWS] = {
    {{1000, 0, 25, 0}, {-100000, 0, 0}},
    {{1000, 10, 5, 8}, {-50000, -20000, 40000}},
    {{1000, 20, -15, 15}, {0, -40000, 80000}},
};

/* A frame of the session. */
enum { ROOM = 0, OTHER_ROOM = 1, BLANK = -1 };
typedef struct step {
  room_view view;
  int32_t room;
  sphc_format format;
  uint32_t prior; /* SPHC_PRIOR_ flags */
} step;

#define TRACKING_STEPS 11
static const step tracking_steps[TRACKING_STEPS] = {
    {{{1000, 2, 22, 2}, {-90000, -4000, 8000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 4, 18, 3}, {-80000, -8000, 16000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 6, 14, 5}, {-70000, -12000, 24000}}, ROOM, SPHC_FORMAT_RGB8, 0},
    {{{1000, 8, 10, 6}, {-60000, -16000, 32000}}, ROOM, SPHC_FORMAT_BGR8, SPHC_PRIOR_ODOMETRY},
    {{{1000, 10, 6, 8}, {-50000, -20000, 40000}}, ROOM, SPHC_FORMAT_GRAY8, SPHC_PRIOR_ODOMETRY},
    {{{1000, 12, 2, 9}, {-40000, -24000, 48000}}, BLANK, SPHC_FORMAT_GRAY8, SPHC_PRIOR_ODOMETRY},
    {{{1000, 14, -2, 11}, {-30000, -28000, 56000}}, ROOM, SPHC_FORMAT_GRAY8, SPHC_PRIOR_ODOMETRY},
    {{{1000, 60, -250, 40}, {400000, 100000, 300000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 62, -255, 41}, {410000, 102000, 305000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 18, -10, 14}, {-10000, -36000, 72000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 20, -14, 15}, {0, -40000, 80000}}, ROOM, SPHC_FORMAT_GRAY8, SPHC_PRIOR_UP},
};
#define SINGLE_STEPS 6
static const step single_steps[SINGLE_STEPS] = {
    {{{1000, 5, 15, 4}, {-75000, -10000, 20000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 15, -5, 11}, {-25000, -30000, 60000}}, ROOM, SPHC_FORMAT_RGB8, SPHC_PRIOR_UP},
    {{{1000, 5, 15, 4}, {-75000, -10000, 20000}}, OTHER_ROOM, SPHC_FORMAT_GRAY8, 0},
    {{{1000, 10, 5, 40}, {-60000, -20000, 30000}}, ROOM, SPHC_FORMAT_GRAY8, SPHC_PRIOR_POSE},
    {{{1000, 15, -5, 11}, {-25000, -30000, 60000}}, BLANK, SPHC_FORMAT_GRAY8, SPHC_PRIOR_POSE},
    {{{1000, -5, 40, 0}, {-300000, 40000, 200000}}, ROOM, SPHC_FORMAT_GRAY8, 0},
};

/* ---- memory ---- */

#define ALIGNED __attribute__((aligned(64)))
static ALIGNED uint8_t view_memory[1024], state_memory[1 << 18], scratch_memory[6 << 20];
static ALIGNED uint8_t features_memory[SPHC_FEATURES_BYTES_MAX(MAX_KEYPOINTS, COLOR_WIDTH, COLOR_HEIGHT)];
static uint8_t gray[COLOR_HEIGHT * COLOR_WIDTH], color[3 * COLOR_HEIGHT * COLOR_WIDTH];
static uint16_t depth[DEPTH_HEIGHT * DEPTH_WIDTH];

static void forget_memory(void) {
  FORGET(view_memory);
  FORGET(state_memory);
  FORGET(scratch_memory);
  FORGET(features_memory);
}

typedef struct session {
  replay_line_fn print;
  void *user;
  sphc_map *map;
  sphc_message message;
  int failed;
} session;

static void print(session *s, const line *l) { s->print(s->user, l->text); }

static int works(session *s, const char *what, sphc_status status) {
  line l = {"", 0};
  if (status >= 0) return 1;
  s->failed = 1;
  line_text(&l, what);
  line_text(&l, ": ");
  line_text(&l, sphc_status_name(status));
  line_text(&l, " ");
  line_text(&l, s->message.text);
  print(s, &l);
  return 0;
}

/* ---- frames ---- */

static sphc_camera pinhole(const room_camera *camera) {
  const sphc_camera made = {
      SPHC_CAMERA_PINHOLE,
      (uint32_t)camera->width,
      (uint32_t)camera->height,
      4,
      {camera->focal_px, camera->focal_px, camera->width / 2.0, camera->height / 2.0, 0, 0, 0, 0, 0, 0, 0, 0}};
  return made;
}

static sphc_rigid camera_from_map(const room_view *view) {
  static const sphc_rigid nothing = {{1, 0, 0, 0}, {0, 0, 0}};
  sphc_rigid pose;
  for (int i = 0; i < 4; ++i) pose.q_wxyz[i] = view->q_wxyz[i];
  for (int i = 0; i < 3; ++i) pose.t_m[i] = (view->position_um[i] - replay_centre_um[i]) / 1e6;
  sphc_rigid_compose(&nothing, &pose, &pose); /* of unit length from here on */
  sphc_rigid_inverse(&pose, &pose);
  return pose;
}

/* What a device might know: all of it, the flags say what counts. */
static sphc_localizer_prior prior_of(const step *what) {
  static const sphc_rigid odometry_from_map = {{0.8, 0, 0.6, 0}, {3, -1, 2}};
  sphc_localizer_prior prior = {0};
  sphc_rigid map_from_camera;
  const double origin[3] = {0, 0, 0}, up[3] = {0, -1, 0};
  double at[3];
  prior.struct_size = sizeof prior;
  prior.flags = what->prior;
  prior.camera_from_map = camera_from_map(&what->view);
  prior.rotation_sigma_rad = 0.05;
  prior.translation_sigma_m = 0.1;
  sphc_rigid_apply(&prior.camera_from_map, up, prior.up_camera);
  sphc_rigid_apply(&prior.camera_from_map, origin, at);
  for (int i = 0; i < 3; ++i) prior.up_camera[i] -= at[i], prior.up_map[i] = up[i];
  prior.up_sigma_rad = 0.01;
  sphc_rigid_inverse(&prior.camera_from_map, &map_from_camera);
  sphc_rigid_compose(&odometry_from_map, &map_from_camera, &prior.odometry_from_camera);
  prior.odometry_rotation_sigma_rad = 0.002;
  prior.odometry_translation_sigma_m = 0.002;
  return prior;
}

static void render(const step *what) {
  const room_view beside = room_beside(&what->view, baseline_um);
  if (what->room >= 0) room_render_gray(&replay_color_camera, &what->view, (uint32_t)what->room, gray);
  for (size_t i = 0; i < sizeof gray; ++i) {
    if (what->room == BLANK) gray[i] = 90;
    color[3 * i] = gray[i];
    color[3 * i + 1] = (uint8_t)(gray[i] - gray[i] / 8);
    color[3 * i + 2] = (uint8_t)(gray[i] / 2);
  }
  room_render_depth(&depth_camera, &beside, depth);
}

static sphc_image image(const void *data, const room_camera *camera, uint32_t pixel_bytes, sphc_format format) {
  const sphc_image made = {data, (uint32_t)camera->width, (uint32_t)camera->height,
                           pixel_bytes * (uint32_t)camera->width, format};
  return made;
}

static sphc_localizer_frame frame_of(const step *what, uint32_t index) {
  const int gray_wanted = what->format == SPHC_FORMAT_GRAY8;
  sphc_localizer_frame frame = {0};
  frame.struct_size = sizeof frame;
  frame.sequence = index;
  frame.color_time_ns = 1000000000 + 33000000 * (int64_t)index;
  frame.depth_time_ns = frame.color_time_ns + 3000000;
  frame.color = image(gray_wanted ? gray : color, &replay_color_camera, gray_wanted ? 1 : 3, what->format);
  frame.depth = image(depth, &depth_camera, 2, SPHC_FORMAT_DEPTH16);
  return frame;
}

/* ---- what came out ---- */

/* Of the axis along which the camera's centre is farthest from where the image was rendered. */
static int64_t error_mm(const sphc_rigid *estimate, const room_view *view) {
  sphc_rigid found = *estimate, truth = camera_from_map(view);
  double worst = 0;
  sphc_rigid_inverse(&found, &found);
  sphc_rigid_inverse(&truth, &truth);
  for (int i = 0; i < 3; ++i) {
    const double error = found.t_m[i] - truth.t_m[i];
    if (error > worst || -error > worst) worst = error > 0 ? error : -error;
  }
  return (int64_t)(worst * 1000);
}

static void print_result(session *s, const char *mode, uint32_t index, const step *what,
                         const sphc_localizer_result *r) {
  line l = {"", 0};
  const double *depth_bias[] = {&r->depth.mid_m,          &r->depth.offset_m,    &r->depth.slope,
                                &r->depth.offset_sigma_m, &r->depth.slope_sigma, &r->depth.noise_scale};
  uint64_t bias = DIGEST_START;
  line_number(&l, mode, index);
  line_number(&l, "outcome", r->outcome);
  line_number(&l, "state", r->state);
  line_number(&l, "keypoints", r->keypoints);
  line_number(&l, "lifted", r->lifted);
  line_number(&l, "matches", r->matches);
  line_number(&l, "inliers", r->inliers);
  line_number(&l, "iterations", r->iterations);
  line_number(&l, "frames", r->frames);
  line_number(&l, "guided", r->guided);
  line_digest(
      &l, "pose",
      digest_doubles(digest_doubles(DIGEST_START, r->camera_from_map.q_wxyz, 4), r->camera_from_map.t_m, 3));
  line_digest(&l, "covariance", digest_doubles(DIGEST_START, r->covariance, 36));
  line_digest(&l, "confidence", digest_doubles(DIGEST_START, &r->confidence, 1));
  for (size_t i = 0; i < sizeof depth_bias / sizeof *depth_bias; ++i) bias = digest_doubles(bias, depth_bias[i], 1);
  line_digest(&l, "depth", bias);
  if (r->outcome == SPHC_OUTCOME_LOCALIZED) {
    const int64_t error = error_mm(&r->camera_from_map, &what->view);
    line_number(&l, "error_mm", error);
    if (error > 50) s->failed = 1;
  }
  print(s, &l);
}

/* Every other frame in two halves, which makes no difference. */
static sphc_status locate(sphc_localizer *localizer, sphc_features *features, const sphc_localizer_frame *frame,
                          uint32_t index, sphc_localizer_result *result) {
  if (index % 2 == 0) return sphc_localizer_process(localizer, frame, result);
  const sphc_status status = sphc_localizer_extract(localizer, frame, features);
  return status < 0 ? status : sphc_localizer_locate(localizer, frame, features, result);
}

static void replay_steps(session *s, const char *name, sphc_localizer_mode mode, const step *steps,
                         uint32_t count) {
  sphc_localizer_config config;
  sphc_localizer *localizer = NULL;
  sphc_features *features = NULL;
  uint64_t seen = DIGEST_START;
  line l = {"", 0};
  if (!works(s, "config", sphc_localizer_config_init(&config, sizeof config))) return;
  config.mode = mode;
  config.rig.color_camera = pinhole(&replay_color_camera);
  config.rig.depth_camera = pinhole(&depth_camera);
  config.rig.color_from_depth.t_m[0] = baseline_um / 1e6;
  config.max_keypoints = MAX_KEYPOINTS;
  config.depth_sigma_m = 0.002;
  if (!works(s, name,
             sphc_localizer_init(state_memory, sizeof state_memory, scratch_memory, sizeof scratch_memory, &config,
                                 &localizer, &s->message)) ||
      !works(s, name,
             sphc_features_init(features_memory, sizeof features_memory, &config, &features, &s->message)) ||
      !works(s, name, sphc_localizer_set_map(localizer, 0, s->map)) ||
      !works(s, name, sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_MAX_ITERATIONS, 5000)))
    return;
  for (uint32_t i = 0; i < count; ++i) {
    sphc_localizer_frame frame = frame_of(&steps[i], i);
    const sphc_localizer_prior prior = prior_of(&steps[i]);
    sphc_localizer_result result = {0};
    result.struct_size = sizeof result;
    if (steps[i].prior) frame.prior = &prior;
    render(&steps[i]);
    seen = digest_bytes(digest_bytes(seen, gray, sizeof gray), depth, sizeof depth);
    if (works(s, sphc_localizer_message(localizer), locate(localizer, features, &frame, i, &result)))
      print_result(s, name, i, &steps[i], &result);
  }
  sphc_features_fini(&features);
  sphc_localizer_fini(&localizer);
  line_text(&l, name);
  line_digest(&l, "images", seen); /* if these differ, the rest says nothing */
  print(s, &l);
}

/* ---- the rest of the interface that computes ---- */

static const sphc_camera distorted[3] = {
    {SPHC_CAMERA_BROWN5, 320, 240, 9, {250, 251, 159, 121, -0.12, 0.03, 0.001, -0.0005, 0.002, 0, 0, 0}},
    {SPHC_CAMERA_BROWN8, 320, 240, 12, {250, 251, 159, 121, 0.5, -0.2, 0.0007, -0.0003, 0.01, 0.8, -0.15, 0.02}},
    {SPHC_CAMERA_KANNALA_BRANDT4, 200, 160, 8, {110, 109, 101, 79, 0.03, -0.01, 0.004, -0.001, 0, 0, 0, 0}},
};

/* Pixels to bearings and back, beyond the images too. */
static void replay_cameras(session *s) {
  for (int32_t which = 0; which < 3; ++which) {
    uint64_t digest = DIGEST_START;
    int64_t solved = 0;
    line l = {"", 0};
    for (int32_t y = -40; y < 300; y += 17)
      for (int32_t x = -40; x < 400; x += 17) {
        const double pixel_px[2] = {x + 0.25, y + 0.75};
        double bearing[3] = {0, 0, 0}, again_px[2] = {0, 0};
        if (sphc_camera_unproject(&distorted[which], pixel_px, bearing) != SPHC_OK) continue;
        if (sphc_camera_project(&distorted[which], bearing, again_px) != SPHC_OK) continue;
        digest = digest_doubles(digest_doubles(digest, bearing, 3), again_px, 2);
        ++solved;
      }
    line_number(&l, "camera", which);
    line_number(&l, "pixels", solved);
    line_digest(&l, "bearings", digest);
    print(s, &l);
  }
}

/* A whole depth image into each distorted colour camera. */
static void replay_aligner(session *s) {
  for (int32_t which = 0; which < 2; ++which) {
    static uint16_t aligned_depth[COLOR_HEIGHT * COLOR_WIDTH];
    const sphc_image raw = image(depth, &depth_camera, 2, SPHC_FORMAT_DEPTH16);
    sphc_aligner *aligner = NULL;
    sphc_aligner_config config;
    sphc_aligned aligned = {0};
    line l = {"", 0};
    if (!works(s, "aligner config", sphc_aligner_config_init(&config, sizeof config))) return;
    config.rig.color_camera = distorted[which];
    config.rig.depth_camera = distorted[2];
    config.rig.color_from_depth.t_m[0] = baseline_um / 1e6;
    if (!works(s, "aligner",
               sphc_aligner_init(scratch_memory, sizeof scratch_memory, &config, &aligner, &s->message)))
      return;
    aligned.struct_size = sizeof aligned;
    aligned.depth = aligned_depth;
    aligned.mask = gray;
    aligned.confidence = color;
    aligned.depth_stride_bytes = 2 * COLOR_WIDTH;
    aligned.mask_stride_bytes = aligned.confidence_stride_bytes = COLOR_WIDTH;
    if (!works(s, sphc_aligner_message(aligner), sphc_aligner_process(aligner, &raw, &aligned))) return;
    line_number(&l, "aligner", which);
    line_digest(&l, "depth", digest_bytes(DIGEST_START, aligned_depth, sizeof aligned_depth));
    line_digest(&l, "mask", digest_bytes(DIGEST_START, gray, sizeof gray));
    line_digest(&l, "confidence", digest_bytes(DIGEST_START, color, sizeof gray));
    print(s, &l);
    sphc_aligner_fini(&aligner);
  }
}

/* A device's clock 37 ppm fast, arrivals late by up to 8 ms. */
static void replay_clock(session *s) {
  sphc_clock_mapper *mapper = NULL;
  sphc_clock_mapper_config config;
  sphc_clock_mapping mapping = {0};
  uint32_t noise = 1;
  line l = {"", 0};
  if (!works(s, "clock config", sphc_clock_mapper_config_init(&config, sizeof config)) ||
      !works(s, "clock",
             sphc_clock_mapper_init(scratch_memory, sizeof scratch_memory, &config, &mapper, &s->message)))
    return;
  for (int64_t i = 0; i < 300; ++i) {
    const int64_t time_ns = i * 33333333;
    noise = noise * 1664525u + 1013904223u;
    works(s, "clock add",
          sphc_clock_mapper_add(mapper, time_ns + time_ns / 1000000 * 37, time_ns + 5000000 + (noise >> 9)));
  }
  mapping.struct_size = sizeof mapping;
  if (!works(s, "clock get", sphc_clock_mapper_get(mapper, &mapping))) return;
  line_number(&l, "clock offset_ns", mapping.offset_ns);
  line_number(&l, "sigma_ns", mapping.sigma_ns);
  line_digest(&l, "drift", digest_doubles(DIGEST_START, &mapping.drift_ppm, 1));
  print(s, &l);
  sphc_clock_mapper_fini(&mapper);
}

static void replay_map(session *s) {
  sphc_map_info info = {0};
  uint64_t digest = DIGEST_START;
  line l = {"", 0};
  info.struct_size = sizeof info;
  if (!works(s, "map info", sphc_map_get_info(s->map, &info))) return;
  for (uint32_t i = 0; i < info.point_count; ++i) {
    double direction[3];
    if (works(s, "direction", sphc_map_direction(s->map, i, direction)))
      digest = digest_doubles(digest, direction, 3);
  }
  line_number(&l, "map points", info.point_count);
  line_digest(&l, "directions", digest);
  print(s, &l);
}

int replay_run(const void *map_file, size_t map_bytes, replay_line_fn print_line, void *user) {
  session s = {print_line, user, NULL, {""}, 0};
  forget_memory();
  if (!works(&s, "map", sphc_map_init(view_memory, sizeof view_memory, map_file, map_bytes, &s.map, &s.message)))
    return 1;
  replay_map(&s);
  replay_cameras(&s);
  replay_steps(&s, "tracking", SPHC_MODE_TRACKING, tracking_steps, TRACKING_STEPS);
  replay_steps(&s, "single", SPHC_MODE_SINGLE, single_steps, SINGLE_STEPS);
  replay_aligner(&s);
  replay_clock(&s);
  sphc_map_fini(&s.map);
  return s.failed;
}

/* ---- comparing ---- */

typedef struct comparison {
  const char *rest; /* of what is expected */
  replay_line_fn print;
  void *user;
  int differs;
} comparison;

static void compare_line(void *user, const char *text) {
  comparison *c = (comparison *)user;
  const char *expected = c->rest;
  size_t i = 0;
  while (text[i] && text[i] == expected[i]) ++i;
  while (*c->rest && *c->rest != '\n') ++c->rest;
  if (*c->rest) ++c->rest;
  if (!text[i] && expected[i] == '\n') return;
  c->differs = 1;
  c->print(c->user, text);
}

int replay_check(const void *map_file, size_t map_bytes, const char *expected, replay_line_fn print_line,
                 void *user) {
  comparison c = {expected, print_line, user, 0};
  const int failed = replay_run(map_file, map_bytes, compare_line, &c);
  return failed || c.differs || *c.rest;
}
