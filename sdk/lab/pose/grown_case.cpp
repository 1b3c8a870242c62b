#include "lab/pose/grown_case.h"

#include <algorithm>
#include <cmath>

#include "lab/common/interleave.h"
#include "lab/common/normal.h"

namespace sphc::host {
namespace {

constexpr double kFreshNoise = 0.5, kFakeVariance = 0.1;

size_t pick(size_t count, Random *random) { return random->below(static_cast<uint32_t>(count)); }

// Which rows of the original make up `count` rows; those from `count of original` on are copies.
std::vector<size_t> chooseRows(size_t available, size_t count, Random *random) {
  std::vector<size_t> rows = shuffledOrder(available, random);
  if (count < available) rows.resize(count);
  while (rows.size() < count) rows.push_back(pick(available, random));
  return rows;
}

// As the paper makes fakes: around the direction of some true row.
Vector3 fakeAmong(const std::vector<Correspondence> &rows, const std::vector<bool> &is_true, Random *random) {
  size_t base = pick(rows.size(), random);
  for (int i = 0; i < 1000 && !is_true[base]; ++i) base = pick(rows.size(), random);
  return (rows[base].direction + std::sqrt(kFakeVariance) * normalVector(random)).normalized();
}

void addFreshNoise(const PinholeCamera &camera, const CaseNoise &noise, Random *random, LiftedPoint *lifted) {
  const double z = lifted->point_m.z();
  const double across = kFreshNoise * noise.pixel_sigma_px / camera.fx_px;
  const double dz = kFreshNoise * (noise.depth_sigma_m + noise.depth_sigma_per_m2 * z * z) * normalOf(random);
  const double dx = across * normalOf(random), dy = across * normalOf(random);
  const Vector3 ray = lifted->point_m / z + Vector3(dx, dy, 0);
  lifted->point_m = std::max(z + dz, kNearestDepthM) * ray;
}

void resizeTruePoints(const PoseCase &original, size_t count, const CaseNoise &noise, Random *random, PoseCase *c) {
  const size_t available = original.true_points_map_m.size();
  c->true_pixels_px.clear();
  c->true_points_map_m.clear();
  if (available == 0) return;
  for (const size_t row : chooseRows(available, count, random)) {
    const bool copy = c->true_points_map_m.size() >= available;
    const double sigma = copy ? kFreshNoise * noise.pixel_sigma_px : 0;
    const double du = sigma * normalOf(random), dv = sigma * normalOf(random);
    c->true_pixels_px.push_back(original.true_pixels_px[row] + Vector2(du, dv));
    c->true_points_map_m.push_back(original.true_points_map_m[row]);
  }
}

void turn(std::vector<Correspondence> *rows, std::vector<bool> *is_true, double eta, Random *random) {
  const auto wanted = static_cast<size_t>(std::lround(eta * static_cast<double>(rows->size())));
  auto left = static_cast<size_t>(std::count(is_true->begin(), is_true->end(), true));
  for (const size_t i : shuffledOrder(rows->size(), random)) {
    if (left <= wanted) return;
    if (!(*is_true)[i]) continue;
    (*rows)[i].direction = fakeAmong(*rows, *is_true, random);
    (*is_true)[i] = false;
    --left;
  }
}

void dilute(std::vector<Correspondence> *rows, std::vector<bool> *is_true, double eta, Random *random) {
  const size_t available = rows->size();
  const auto trues = std::count(is_true->begin(), is_true->end(), true);
  const auto wanted = static_cast<size_t>(std::lround(static_cast<double>(trues) / eta));
  while (available > 0 && rows->size() < wanted) {
    Correspondence row = (*rows)[pick(available, random)];
    row.direction = fakeAmong(*rows, *is_true, random);
    rows->push_back(row);
    is_true->push_back(false);
  }
}

}  // namespace

PoseCase resizedCase(const PoseCase &original, size_t count, const CaseNoise &noise, Random *random) {
  PoseCase c = original;
  c.without_depth.clear();
  c.without_depth_is_true.clear();
  const size_t available = original.correspondences.size();
  if (available == 0) return c;
  c.correspondences.clear();
  c.is_true.clear();
  for (const size_t row : chooseRows(available, count, random)) {
    Correspondence correspondence = original.correspondences[row];
    if (c.correspondences.size() >= available) {
      addFreshNoise(c.camera, noise, random, &correspondence.lifted);
      if (!original.is_true[row])
        correspondence.direction = fakeAmong(original.correspondences, original.is_true, random);
    }
    c.correspondences.push_back(correspondence);
    c.is_true.push_back(original.is_true[row]);
  }
  resizeTruePoints(original, count, noise, random, &c);
  return c;
}

PoseCase turnedCase(const PoseCase &original, double eta, Random *random) {
  PoseCase c = original;
  turn(&c.correspondences, &c.is_true, eta, random);
  turn(&c.without_depth, &c.without_depth_is_true, eta, random);
  c.eta_percent = static_cast<uint32_t>(std::lround(100 * eta));
  return c;
}

PoseCase dilutedCase(const PoseCase &original, double eta, Random *random) {
  PoseCase c = original;
  dilute(&c.correspondences, &c.is_true, eta, random);
  dilute(&c.without_depth, &c.without_depth_is_true, eta, random);
  c.eta_percent = static_cast<uint32_t>(std::lround(100 * eta));
  return c;
}

}  // namespace sphc::host
