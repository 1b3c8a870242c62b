/* What every binding must find: a session of the C interface, written so that any language reads it without a
 * library.
 *
 *     write_golden FOLDER        the folder is there; files in it are replaced
 *
 * FOLDER gets room.sphc, config.csv, cameras.csv, session.csv (a row for each frame with what C found in it) and
 * the images as bare bytes. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <spherecloud/spherecloud.h>

#include "aligned_block.h"
#include "data.h"
#include "room.h"

enum { FRAMES = 10, BLANK = 6, UP_FROM = 8, MAP_ID = 7 };
static const room_camera color_camera = {320, 240, 250}, depth_camera = {200, 160, 140};
static const int32_t depth_right_um = 40000;

static _Alignas(64) uint8_t map_memory[SPHC_MAP_BYTES_MAX];
static uint8_t gray[320 * 240];
static uint16_t depth[200 * 160];

static void stop(const char *what, const char *why) {
  fprintf(stderr, "write_golden: %s: %s\n", what, why);
  exit(1);
}

static void must(const char *what, sphc_status status, const char *why) {
  if (status < 0) stop(what, why);
}

static void *memory(uint64_t bytes, void **block) {
  void *made = aligned_block((size_t)bytes, 64, block);
  if (!made) stop("memory", "none left");
  return made;
}

static FILE *file(const char *folder, const char *name) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *opened = fopen(path, "wb");
  if (!opened) stop(path, "cannot write; does the folder exist?");
  return opened;
}

static void write_bytes(const char *folder, const char *name, const void *bytes, size_t size) {
  FILE *out = file(folder, name);
  if (fwrite(bytes, 1, size, out) != size || fclose(out)) stop(name, "cannot write; is the disk full?");
}

static sphc_camera pinhole(const room_camera *camera) {
  sphc_camera made = {SPHC_CAMERA_PINHOLE, (uint32_t)camera->width, (uint32_t)camera->height, 4, {0}};
  made.params[0] = made.params[1] = camera->focal_px;
  made.params[2] = camera->width / 2.0;
  made.params[3] = camera->height / 2.0;
  return made;
}

static sphc_localizer_config config_of_session(void) {
  sphc_localizer_config config;
  must("config", sphc_localizer_config_init(&config, sizeof config), "struct_size");
  config.rig.color_camera = pinhole(&color_camera);
  config.rig.depth_camera = pinhole(&depth_camera);
  config.rig.color_from_depth.t_m[0] = depth_right_um / 1e6;
  config.max_keypoints = 400;
  config.depth_sigma_m = 0.002;
  return config;
}

static void write_setup(const char *folder, const sphc_localizer_config *config) {
  FILE *out = file(folder, "config.csv");
  fprintf(out,
          "field,value\nmap_id,%d\nmax_keypoints,%" PRIu32 "\ndepth_sigma_m,%.17g\ncolor_from_depth_x_m,%.17g\n",
          MAP_ID, config->max_keypoints, config->depth_sigma_m, config->rig.color_from_depth.t_m[0]);
  fclose(out);
  out = file(folder, "cameras.csv");
  fprintf(out, "camera,model,width,height,fx,fy,cx,cy\n");
  for (int i = 0; i < 2; ++i) {
    const sphc_camera *c = i ? &config->rig.depth_camera : &config->rig.color_camera;
    fprintf(out, "%s,%" PRId32 ",%" PRIu32 ",%" PRIu32 ",%.17g,%.17g,%.17g,%.17g\n", i ? "depth" : "color",
            c->model, c->width, c->height, c->params[0], c->params[1], c->params[2], c->params[3]);
  }
  fclose(out);
  write_bytes(folder, "room.sphc", data_map, (size_t)(data_map_end - data_map));
}

/* A walk along the wall that the map shows. */
static room_view view_of(int32_t i) {
  const room_view view = {{1000, 2 + 2 * i, 22 - 4 * i, 2 + (3 * i) / 2},
                          {-90000 + 10000 * i, -4000 - 4000 * i, 8000 + 8000 * i}};
  return view;
}

static void render(int32_t index) {
  const room_view view = view_of(index), beside = room_beside(&view, depth_right_um);
  room_render_gray(&color_camera, &view, 0, gray);
  room_render_depth(&depth_camera, &beside, depth);
  if (index == BLANK) memset(gray, 90, sizeof gray);
}

/* The vertical as an inertial sensor tells it, here roughly. */
static sphc_localizer_prior up_of(void) {
  sphc_localizer_prior prior;
  must("prior", sphc_localizer_prior_init(&prior, sizeof prior), "struct_size");
  prior.flags = SPHC_PRIOR_UP;
  prior.map_id = MAP_ID;
  prior.up_camera[1] = prior.up_map[1] = -1;
  prior.up_sigma_rad = 0.25;
  return prior;
}

static void write_pose(FILE *out, const sphc_rigid *pose) {
  for (int i = 0; i < 4; ++i) fprintf(out, ",%.17g", pose->q_wxyz[i]);
  for (int i = 0; i < 3; ++i) fprintf(out, ",%.17g", pose->t_m[i]);
}

static void write_frame(const char *folder, FILE *out, sphc_localizer *localizer, int32_t index) {
  char color_name[32], depth_name[32];
  snprintf(color_name, sizeof color_name, "color_%02d.gray8", (int)index);
  snprintf(depth_name, sizeof depth_name, "depth_%02d.depth16", (int)index);
  render(index);
  write_bytes(folder, color_name, gray, sizeof gray);
  write_bytes(folder, depth_name, depth, sizeof depth);

  const sphc_localizer_prior prior = up_of();
  sphc_localizer_frame frame;
  must("frame", sphc_localizer_frame_init(&frame, sizeof frame), "struct_size");
  frame.sequence = (uint32_t)index;
  frame.color_time_ns = 1000000000 + INT64_C(33000000) * index;
  frame.depth_time_ns = frame.color_time_ns + 3000000;
  frame.color = (sphc_image){gray, 320, 240, 320, SPHC_FORMAT_GRAY8};
  frame.depth = (sphc_image){depth, 200, 160, 400, SPHC_FORMAT_DEPTH16};
  if (index >= UP_FROM) frame.prior = &prior;

  sphc_localizer_result result;
  sphc_localizer_prediction predicted;
  must("result", sphc_localizer_result_init(&result, sizeof result), "struct_size");
  must("prediction", sphc_localizer_prediction_init(&predicted, sizeof predicted), "struct_size");
  const sphc_status status = sphc_localizer_process(localizer, &frame, &result);
  must("frame", status, sphc_localizer_message(localizer));
  const sphc_status known = sphc_localizer_predict(localizer, frame.color_time_ns + 20000000, &predicted);
  must("prediction", known, sphc_localizer_message(localizer));

  fprintf(out, "%d,%s,%s,%" PRId64 ",%" PRId64 ",%d,%.17g", (int)index, color_name, depth_name, frame.color_time_ns,
          frame.depth_time_ns, frame.prior != NULL, prior.up_sigma_rad);
  fprintf(out, ",%" PRId32 ",%" PRId32 ",%" PRId32 ",%" PRIu32 ",%" PRIu32 ",%.17g", status, result.outcome,
          result.state, result.keypoints, result.inliers, result.confidence);
  write_pose(out, &result.camera_from_map);
  fprintf(out, ",%.17g,%.17g,%" PRId32, result.covariance[0], result.covariance[35], known);
  write_pose(out, &predicted.camera_from_map);
  fprintf(out, "\n");
}

int main(int count, char **words) {
  if (count != 2) stop("usage", "write_golden FOLDER");
  const sphc_localizer_config config = config_of_session();
  sphc_message message = {""};
  sphc_map *map = NULL;
  sphc_localizer *localizer = NULL;
  sphc_memory need;
  write_setup(words[1], &config);
  must("map",
       sphc_map_init(map_memory, sizeof map_memory, data_map, (size_t)(data_map_end - data_map), &map, &message),
       message.text);
  must("memory", sphc_localizer_memory(&config, &need, &message), message.text);
  void *state_block, *scratch_block;
  void *state = memory(need.state_bytes, &state_block), *scratch = memory(need.scratch_bytes, &scratch_block);
  must("localizer",
       sphc_localizer_init(state, (size_t)need.state_bytes, scratch, (size_t)need.scratch_bytes, &config,
                           &localizer, &message),
       message.text);
  must("map", sphc_localizer_set_map(localizer, MAP_ID, map), sphc_localizer_message(localizer));

  FILE *out = file(words[1], "session.csv");
  fprintf(out, "sequence,color_file,depth_file,color_time_ns,depth_time_ns,has_up,up_sigma_rad,");
  fprintf(out, "status,outcome,state,keypoints,inliers,confidence,");
  fprintf(out, "q_w,q_x,q_y,q_z,t_x,t_y,t_z,covariance_0,covariance_35,");
  fprintf(out, "predicted_status,predicted_q_w,predicted_q_x,predicted_q_y,predicted_q_z,");
  fprintf(out, "predicted_t_x,predicted_t_y,predicted_t_z\n");
  for (int32_t i = 0; i < FRAMES; ++i) write_frame(words[1], out, localizer, i);
  if (fclose(out)) stop("session.csv", "cannot write; is the disk full?");
  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  free(state_block);
  free(scratch_block);
  return 0;
}
