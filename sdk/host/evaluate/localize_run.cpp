#include "host/evaluate/localize_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "host/base/checked_call.h"
#include "host/base/usage_error.h"
#include "host/evaluate/played_odometry.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

int64_t steadyNanoseconds(void *) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

void checkDone(const std::string &what, const spherecloud::Status &status) {
  if (status.failed()) throw std::runtime_error(what + ": " + status.text() + " [" + status.name() + "]");
}

// Of a config and parameters.
void checkMade(const spherecloud::Status &status) {
  const std::string what = "cannot make the localizer";
  if (status.code() == SPHC_E_ARGUMENT) throw ArgumentError(what + ": " + status.text());
  checkDone(what, status);
}

const char *modelName(sphc_camera_model model) {
  switch (model) {
    case SPHC_CAMERA_PINHOLE:
      return "pinhole";
    case SPHC_CAMERA_BROWN5:
      return "Brown-Conrady 5";
    case SPHC_CAMERA_BROWN8:
      return "Brown-Conrady 8";
    case SPHC_CAMERA_KANNALA_BRANDT4:
      return "Kannala-Brandt 4";
    default:
      return "unknown";
  }
}

std::string describeCamera(const sphc_camera &camera) {
  return std::to_string(camera.width) + " x " + std::to_string(camera.height) + ", " + modelName(camera.model) +
         ", f " + fixed(camera.params[0], 1) + " px";
}

// All its digits: 1e-5 is not 0.
std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// One sigma of a 3-vector's length, from its block of the covariance.
double sigmaOf(const double covariance[36], size_t first) {
  double sum = 0;
  for (size_t i = first; i < first + 3; ++i) sum += covariance[7 * i];
  return std::sqrt(sum);
}

sphc_localizer_config withRoomFor(const std::vector<MapFile> &maps, sphc_localizer_config config) {
  config.max_maps = std::max(1u, static_cast<uint32_t>(maps.size()));
  return config;
}

void measureMemory(const sphc_localizer_config &config, Run *run) {
  sphc_memory memory = {};
  orThrow("localizer memory",
          [&](sphc_message *message) { return sphc_localizer_memory(&config, &memory, message); });
  run->state_bytes = memory.state_bytes;
  run->scratch_bytes = memory.scratch_bytes;
  sphc_memory_piece piece = {};
  for (uint32_t i = 0; sphc_localizer_memory_piece(&config, i, &piece) == SPHC_OK; ++i) {
    run->memory.push_back({piece.name, piece.bytes, piece.scratch != 0});
  }
}

void fillAnswer(const LocalizeInput &input, const sphc_localizer_result &result, FrameRecord *frame) {
  frame->outcome = result.outcome;
  frame->localized = result.outcome == SPHC_OUTCOME_LOCALIZED;
  frame->keypoints = result.keypoints;
  frame->lifted = result.lifted;
  frame->matches = result.matches;
  frame->inliers = result.inliers;
  frame->iterations = result.iterations;
  frame->features_us = result.features_us;
  frame->align_us = result.align_us;
  frame->match_us = result.match_us;
  frame->pose_us = result.pose_us;
  frame->state = result.state;
  frame->map = result.map_id;
  frame->frames_together = result.frames;
  frame->guided = result.guided != 0;
  frame->depth = result.depth;
  frame->faults = result.faults;
  frame->cuts = result.cuts;
  frame->hints = result.hints;
  frame->events = result.events;
  frame->jump_m = result.jump_m;
  frame->jump_rad = result.jump_rad;
  if (!frame->localized) return;
  frame->confidence = result.confidence;
  frame->base_from_camera = spherecloud::inverse(result.camera_from_map);
  if (!input.centres_in_world_m.empty()) {  // world_from_map is a translation
    const auto &centre = input.centres_in_world_m[result.map_id];
    for (size_t i = 0; i < 3; ++i) frame->base_from_camera.t_m[i] += centre[i];
  }
  frame->sigma_rotation_deg = sigmaOf(result.covariance, 0) * 180 / M_PI;
  frame->sigma_translation_m = sigmaOf(result.covariance, 3);
}

void fillTruth(const LocalizeInput &input, FrameRecord *frame) {
  if (input.centres_in_world_m.empty()) return;
  const std::optional<sphc_rigid> truth = input.reader->worldFromCamera(frame->index);
  frame->has_truth = truth.has_value();
  if (truth) frame->truth_base_from_camera = *truth;
  judge(frame);
}

FrameRecord processFrame(const LocalizeInput &input, const sphc_localizer_frame &image, uint32_t index,
                         spherecloud::Localizer *localizer, std::vector<sphc_localizer_observation> *room) {
  sphc_localizer_result result = spherecloud::emptyResult();
  const int64_t start = steadyNanoseconds(nullptr);
  const spherecloud::Status status = localizer->process(image, &result);
  const int64_t end = steadyNanoseconds(nullptr);
  checkDone("frame " + std::to_string(image.sequence), status);
  FrameRecord frame;
  frame.index = index;
  frame.sequence = image.sequence;
  frame.time_ns = image.color_time_ns;
  frame.total_us = static_cast<uint32_t>((end - start) / 1000);
  fillAnswer(input, result, &frame);
  fillTruth(input, &frame);
  if (input.observations) {
    const uint32_t count = localizer->observations(room->data(), static_cast<uint32_t>(room->size()));
    input.observations->add(room->data(), std::min<size_t>(count, room->size()));
  }
  return frame;
}

}  // namespace

void setCameras(const sphc_rig &rig, sphc_localizer_config *config) {
  config->rig = rig;
  config->clock = steadyNanoseconds;
}

spherecloud::Localizer makeLocalizer(const sphc_localizer_config &config, const std::vector<MapFile> &maps,
                                     const Parameters &parameters) {
  spherecloud::Localizer localizer;
  checkMade(spherecloud::Localizer::make(withRoomFor(maps, config), &localizer));
  checkMade(parameters.setOn(&localizer));
  for (size_t i = 0; i < maps.size(); ++i)
    checkDone("cannot take the map", localizer.setMap(static_cast<uint32_t>(i), maps[i].map));
  return localizer;
}

std::vector<Setting> describeConfig(const sphc_localizer_config &config, const Parameters &parameters) {
  return {{"colour camera", describeCamera(config.rig.color_camera)},
          {"depth camera", describeCamera(config.rig.depth_camera)},
          {"color_band", bandName(config.color_band)},
          {"seed", std::to_string(config.seed)},
          {"max_keypoints", std::to_string(config.max_keypoints)},
          {"max_ratio", numberText(parameters.max_ratio)},
          {"max_iterations", numberText(parameters.max_iterations)},
          {"min_inliers", numberText(parameters.min_inliers)},
          {"probes", numberText(parameters.probes)},
          {"color_row_time_ns", std::to_string(config.color_row_time_ns)},
          {"depth_min_m", numberText(config.depth_min_m)},
          {"depth_max_m", numberText(config.depth_max_m)},
          {"depth_unit_m", numberText(config.rig.depth_unit_m)},
          {"depth_sigma_m", numberText(config.depth_sigma_m)},
          {"depth_sigma_per_m2", numberText(config.depth_sigma_per_m2)},
          {"amplitude_min", std::to_string(config.amplitude_min)},
          {"pixel_sigma_px", numberText(config.pixel_sigma_px)},
          {"map_sigma_m", numberText(config.map_sigma_m)},
          {"depth_mid_m", numberText(config.depth_mid_m)},
          {"depth_offset_sigma_m", numberText(config.depth_offset_sigma_m)},
          {"depth_slope_sigma", numberText(config.depth_slope_sigma)},
          {"mode", config.mode == SPHC_MODE_TRACKING ? "tracking" : "single"}};
}

void localizeFrames(const LocalizeInput &input, const FrameDone &frame_done,
                    const std::function<void(const std::string &)> &unreadable, Run *run) {
  measureMemory(withRoomFor(input.maps, input.config), run);
  spherecloud::Localizer localizer = makeLocalizer(input.config, input.maps, input.parameters);
  PlayedOdometry odometry(input.reader);
  std::vector<sphc_localizer_observation> room(input.config.max_keypoints);
  const uint32_t count = input.reader->frameCount();
  for (uint32_t i = 0; i < count; ++i) {
    if (input.takes_part && !input.takes_part(i)) continue;
    std::string why;
    std::optional<sphc_localizer_frame> image = input.reader->tryRead(i, &why);
    if (!image) {
      unreadable(why);
      const recording::RecordedImage &color = input.reader->colorOf(i);
      run->unreadable.push_back({i, color.sequence, color.time_ns, why});
    } else {
      image->deadline_us = input.deadline_us;
      if (input.play_odometry) image->prior = odometry.at(i);
      run->frames.push_back(processFrame(input, *image, i, &localizer, &room));
    }
    frame_done(i + 1, count);
  }
}

}  // namespace sphc::host
