#include "lab/rig/run.h"

#include <cmath>
#include <iterator>
#include <stdexcept>

#include "host/evaluate/localize_run.h"
#include "host/report/statistics.h"
#include "lab/common/pose_error.h"

namespace sphc::host {
namespace {

constexpr uint32_t kHeadings = 16;
const RigSetup kSetups[] = {{1, RigTof::kWide}, {2, RigTof::kWide},  {3, RigTof::kWide},
                            {4, RigTof::kWide}, {4, RigTof::kAhead}, {4, RigTof::kAheadAndLeft}};

struct Viewpoint {
  std::string view;
  int64_t time_ns;
  Rigid world_from_camera;
};

Rigid walkPose(const sphc_simulated *room, int64_t time_ns) {
  sphc_rigid pose;
  if (sphc_simulated_pose_at(room, time_ns, &pose) != SPHC_OK) throw std::runtime_error("the walk has no pose");
  return rigidFromC(pose);
}

// Of the walk's second lap, which the map has not seen.
std::vector<Viewpoint> viewpointsOf(const RigInput &input) {
  std::vector<Viewpoint> all;
  const uint32_t frames = sphc_simulated_frame_count(input.room);
  uint32_t walls = 0;
  for (uint32_t i = 0; i < input.views; ++i) {
    int64_t time_ns = 0;
    sphc_simulated_frame_times(input.room, i * frames / input.views, &time_ns, nullptr);
    all.push_back({"walk", time_ns, walkPose(input.room, time_ns)});
  }
  const RigHeadset headset(input.room);
  for (uint32_t i = 0; i < frames * kHeadings && walls < input.views; ++i) {
    int64_t time_ns = 0;
    sphc_simulated_frame_times(input.room, i % frames, &time_ns, nullptr);
    const double heading_rad = (i / frames * 3 + i % frames) % kHeadings * 2 * M_PI / kHeadings;
    Rigid facing;
    const Vector3 centre_m = walkPose(input.room, time_ns).translation_m;
    if (!headset.faceWall(centre_m, heading_rad, time_ns, &facing)) continue;
    all.push_back({"wall", time_ns, facing});
    ++walls;
  }
  return all;
}

void judge(const sphc_localizer_result &result, const Rigid &truth, RigRow *row) {
  ++row->frames;
  row->features_us.push_back(result.features_us);
  row->frame_us.push_back(result.features_us + result.align_us + result.match_us + result.pose_us);
  if (result.outcome != SPHC_OUTCOME_LOCALIZED) return;
  const Rigid found = rigidFromC(result.camera_from_map);
  const double shift_m = shiftM(found, truth), turn_deg = turnRad(found, truth) * 180 / M_PI;
  ++row->localized;
  row->right += shift_m <= kGoodTranslationM && turn_deg <= kGoodRotationDeg;
  row->wrong += shift_m > kWrongTranslationM || turn_deg > kWrongRotationDeg;
  row->errors_mm.push_back(1000 * shift_m);
}

spherecloud::Localizer localizerOf(const RigInput &input, const RigSetup &setup) {
  sphc_localizer_config config = spherecloud::defaultConfig();
  setCameras(config.rig, &config);  // the clock
  RigArrays arrays;
  RigHeadset::setCameras(setup, &arrays, &config);
  config.mode = SPHC_MODE_SINGLE;
  config.max_keypoints = input.keypoints;
  return makeLocalizer(config, *input.maps);
}

}  // namespace

std::vector<RigRow> runRig(const RigInput &input, const RigProgress &progress) {
  std::vector<spherecloud::Localizer> localizers;
  std::vector<RigRow> rows;
  for (const RigSetup &setup : kSetups) localizers.push_back(localizerOf(input, setup));
  for (const char *view : {"walk", "wall"})
    for (const RigSetup &setup : kSetups) {
      rows.emplace_back();
      rows.back().view = view;
      rows.back().setup = setup;
    }
  const RigHeadset headset(input.room);
  const std::vector<Viewpoint> viewpoints = viewpointsOf(input);
  for (uint32_t i = 0; i < viewpoints.size(); ++i) {
    const Viewpoint &at = viewpoints[i];
    const RigShot shot = headset.look(at.world_from_camera, at.time_ns);
    const Rigid world_from_map = {Matrix3::Identity(), input.centre_in_world_m};
    for (size_t s = 0; s < std::size(kSetups); ++s) {
      RigArrays arrays;
      const sphc_localizer_frame frame = RigHeadset::frameOf(shot, at.time_ns, kSetups[s], &arrays);
      sphc_localizer_result result = spherecloud::emptyResult();
      const spherecloud::Status status = localizers[s].process(frame, &result);
      if (status.failed()) throw std::runtime_error(status.text());
      RigRow &row = rows[(at.view == "walk" ? 0 : std::size(kSetups)) + s];
      judge(result, at.world_from_camera.inverse() * world_from_map, &row);
    }
    progress(i + 1, static_cast<uint32_t>(viewpoints.size()));
  }
  return rows;
}

}  // namespace sphc::host
