#include "host/publish/resized_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "host/publish/descriptor_symmetry.h"
#include "host/publish/sphere_cloud.h"
#include "runtime/stages/features/mirrored_descriptor.h"

namespace sphc::host {
namespace {

constexpr double kNoise = 0.45, kLength = 512, kScatter = 0.1;

void appendTurned(const PointModel &model, std::vector<Descriptor> *out) {
  for (const ModelPoint &point : model.points) {
    const Descriptor mirror = mirrored(point.descriptor);
    out->push_back(mirror);
    out->push_back(negative(point.descriptor));
    out->push_back(negative(mirror));
  }
}

Descriptor noisy(const Descriptor &descriptor, SecretRandom *random) {
  double values[kDescriptorBytes], sum2 = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    values[i] = std::max(0.0, descriptor.bytes[i] * (1 + kNoise * random->normal()));
    sum2 += values[i] * values[i];
  }
  const double scale = sum2 > 0 ? kLength / std::sqrt(sum2) : 0;
  Descriptor out;
  for (size_t i = 0; i < kDescriptorBytes; ++i)
    out.bytes[i] = static_cast<uint8_t>(std::lround(std::min(255.0, values[i] * scale)));
  return out;
}

// In the order that the header states; shuffled within each step, so that a part stands for the whole.
std::vector<Descriptor> foreignDescriptors(const PointModel &own, const std::vector<PointModel> &foreign,
                                           size_t count, SecretRandom *random) {
  std::vector<Descriptor> all, turned;
  for (const PointModel &model : foreign)
    for (const ModelPoint &point : model.points) all.push_back(point.descriptor);
  shuffle(&all, random);
  appendTurned(own, &turned);
  for (const PointModel &model : foreign) appendTurned(model, &turned);
  shuffle(&turned, random);
  all.insert(all.end(), turned.begin(), turned.end());
  const size_t real = all.size();
  while (all.size() < count) all.push_back(noisy(all[all.size() % real], random));
  all.resize(count);
  return all;
}

}  // namespace

// Gradients along the keypoint's own direction stay; across it they change sign.
PointModel resizedModel(const PointModel &own, const std::vector<PointModel> &foreign, size_t count,
                        SecretRandom *random) {
  if (own.points.empty()) throw std::runtime_error("the model has no points to resize; record more frames");
  PointModel resized = own;
  std::stable_sort(resized.points.begin(), resized.points.end(),
                   [](const ModelPoint &a, const ModelPoint &b) { return a.observations > b.observations; });
  if (resized.points.size() > count) resized.points.resize(count);
  const size_t missing = count - resized.points.size();
  const Vector3 centre = centreOf(own.points);
  for (const Descriptor &descriptor : foreignDescriptors(own, foreign, missing, random)) {
    ModelPoint point = own.points[random->below(own.points.size())];
    const double x = random->normal(), y = random->normal(), z = random->normal();
    point.position_m += kScatter * (point.position_m - centre).norm() * Vector3(x, y, z);
    point.descriptor = descriptor;
    point.observations = 1;
    resized.points.push_back(point);
  }
  return resized;
}

}  // namespace sphc::host
