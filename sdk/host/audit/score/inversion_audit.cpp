#include "host/audit/score/inversion_audit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/base/elementary.h"

namespace sphc::host {
namespace {

constexpr double kViewsApartDeg = 24;  // of neighbouring views' axes: half a field
constexpr double kSteepestDeg = 48;    // up and down
constexpr size_t kFewPoints = 100;     // in view

// Upright views all around, rows of equal pitch; z is up, the camera's y down.
std::vector<Matrix3> rotationsAllAround() {
  std::vector<Matrix3> rotations;
  for (double pitch_deg = -kSteepestDeg; pitch_deg <= kSteepestDeg; pitch_deg += kViewsApartDeg) {
    const double pitch = pitch_deg * kPi / 180;
    const int count = static_cast<int>(std::ceil(360 / kViewsApartDeg * std::cos(pitch)));
    for (int k = 0; k < count; ++k) {
      const double yaw = 2 * kPi * k / count;
      const Vector3 forward(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
      const Vector3 right = forward.cross(Vector3::UnitZ()).normalized();
      Matrix3 camera_from_map;
      camera_from_map.row(0) = right;
      camera_from_map.row(1) = forward.cross(right);
      camera_from_map.row(2) = forward;
      rotations.push_back(camera_from_map);
    }
  }
  return rotations;
}

}  // namespace

InversionResult invert(Inverter *inverter, const std::string &name, const std::vector<SeenPoints> &seen,
                       const std::vector<TruthView> &truths) {
  InversionResult result;
  result.name = name;
  for (const SeenPoints &points : seen) result.pictures.push_back(inverter->paint(points));
  result.coarse = retrieve(result.pictures, truths, kCoarseCells);
  result.fine = retrieve(result.pictures, truths, kFineCells);
  return result;
}

InversionResult invert(Inverter *inverter, const std::string &name, const std::vector<Vector3> &directions,
                       const std::vector<Descriptor> &descriptors, const std::vector<float> &weights,
                       const std::vector<InversionView> &views) {
  std::vector<SeenPoints> seen;
  for (const InversionView &view : views)
    seen.push_back(see(directions, descriptors, weights, {view.camera_from_map, Vector3::Zero()}));
  return invert(inverter, name, seen, truthsOf(views));
}

std::vector<float> pruned(const std::vector<double> &scores, double share) {
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  const auto kept = static_cast<size_t>(std::lround(share * static_cast<double>(scores.size())));
  std::vector<float> weights(scores.size(), 0);
  for (size_t k = 0; k < std::min(kept, order.size()); ++k) weights[order[k]] = 1;
  return weights;
}

std::vector<InversionView> pseudoTruth(Inverter *inverter, const std::vector<Vector3> &directions,
                                       const std::vector<Descriptor> &descriptors) {
  std::vector<InversionView> views;
  for (const Matrix3 &rotation : rotationsAllAround()) {
    const SeenPoints seen = see(directions, descriptors, {}, {rotation, Vector3::Zero()});
    if (seen.pixels_px.size() < kFewPoints) continue;
    const cv::Mat grey = inverter->paint(seen);
    views.push_back({rotation, {grey, cv::Mat(grey.size(), CV_8U, cv::Scalar(255))}});
  }
  return views;
}

}  // namespace sphc::host
