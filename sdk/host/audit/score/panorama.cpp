#include "host/audit/score/panorama.h"

#include <algorithm>
#include <cmath>

namespace sphc::host {
namespace {

constexpr float kSameSurface = 0.06f;  // relative: ranges this close are one surface
constexpr double kNearM = 0.6;         // the centre may lie in the furniture: what is nearer would hide the room
constexpr RaysOfPixel kPanoramaRays = {3, 3};

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
  const Matrix3 map_from_camera = camera_from_map.transpose();
  return truthView(kPanoramaRays, [&](const Vector3 &ray) {
    Vector2 place;
    const int face = faceOf(map_from_camera * ray, &place);
    const auto cell_of = [](double p) { return std::min(static_cast<int>(p), kSide - 1); };
    const Cell &cell = cells_[indexOf(face, cell_of(place.x()), cell_of(place.y()))];
    return cell.weight == 0 ? -1.0f : cell.sum / cell.weight;
  });
}

}  // namespace sphc::host
