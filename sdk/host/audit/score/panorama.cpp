#include "host/audit/score/panorama.h"

#include <algorithm>
#include <cmath>

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {
namespace {

constexpr float kSameSurface = 0.06f;  // relative: ranges this close are one surface
constexpr double kNearM = 0.6;         // the centre may lie in the furniture: what is nearer would hide the room
constexpr int kSubsamples = 3;         // rays a pixel, both ways
constexpr int kEnough = 3;             // rays that must have met something

}  // namespace

int Panorama::faceOf(const Vector3 &direction, Vector2 *place) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const double depth = direction[axis];
  const Vector2 flat(direction[(axis + 1) % 3] / std::abs(depth), direction[(axis + 2) % 3] / std::abs(depth));
  *place = (flat + Vector2::Ones()) * (kSide / 2.0);
  return 2 * axis + (depth < 0 ? 1 : 0);
}

void Panorama::add(const Vector3 &offset_m, double radius_m, float grey) {
  const double range_m = offset_m.norm();
  if (!(range_m > kNearM)) return;
  Vector2 place;
  const int face = faceOf(offset_m, &place);
  const double radius = std::clamp(radius_m / range_m * kSide / 2, 0.5, 8.0);
  const auto first = [&](double middle) { return std::clamp(static_cast<int>(middle - radius), 0, kSide - 1); };
  const auto last = [&](double middle) { return std::clamp(static_cast<int>(middle + radius), 0, kSide - 1); };
  const auto range = static_cast<float>(range_m);
  for (int y = first(place.y()); y <= last(place.y()); ++y) {
    for (int x = first(place.x()); x <= last(place.x()); ++x) {
      Cell &cell = cells_[indexOf(face, x, y)];
      if (cell.weight > 0 && range > cell.range_m * (1 + kSameSurface)) continue;  // hidden
      if (cell.weight == 0 || range < cell.range_m * (1 - kSameSurface)) cell = {range, 0, 0};
      cell.sum += grey;
      cell.weight += 1;
    }
  }
}

TruthView Panorama::view(const Matrix3 &camera_from_map) const {
  const int side = VirtualCamera::kSide;
  const Matrix3 map_from_camera = camera_from_map.transpose();
  TruthView view = {cv::Mat(side, side, CV_32F, cv::Scalar(0)), cv::Mat(side, side, CV_8U, cv::Scalar(0))};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      float sum = 0;
      int met = 0;
      for (int i = 0; i < kSubsamples * kSubsamples; ++i) {
        const Vector2 within(i % kSubsamples + 0.5, i / kSubsamples + 0.5);
        const Vector3 ray = map_from_camera * VirtualCamera::ray(Vector2(x, y) + within / kSubsamples);
        Vector2 place;
        const int face = faceOf(ray, &place);
        const auto cell_of = [](double p) { return std::min(static_cast<int>(p), kSide - 1); };
        const Cell &cell = cells_[indexOf(face, cell_of(place.x()), cell_of(place.y()))];
        if (cell.weight == 0) continue;
        sum += cell.sum / cell.weight;
        ++met;
      }
      if (met < kEnough) continue;
      view.grey.at<float>(y, x) = sum / static_cast<float>(met);
      view.seen.at<uint8_t>(y, x) = 255;
    }
  }
  return view;
}

}  // namespace sphc::host
