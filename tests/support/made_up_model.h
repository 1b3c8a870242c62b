// Private point models of rooms that do not exist, and how other recordings would show them.
#pragma once
#include "host/import/point_model.h"
#include "tests/support/random_numbers.h"

namespace sphc::test {

// Descriptors are noise, so that no two points of a model are alike.
inline host::PointModel madeUpRoom(uint32_t points, uint64_t seed, const Vector3 &middle_m = {10, -4, 2}) {
  Random random(seed);
  host::PointModel model;
  for (uint32_t i = 0; i < points; ++i) {
    Vector3 p(uniformIn(&random, -2, 2), uniformIn(&random, -1.5, 1.5), uniformIn(&random, -1.2, 1.2));
    const int wall = static_cast<int>(random.below(3));
    p[wall] = p[wall] < 0 ? -2 : 2;  // points lie on walls
    model.points.push_back({middle_m + p, randomDescriptor(&random), 0.01, 1 + random.below(5)});
  }
  return model;
}

// Every byte moves by `by`, up or down, which moves the descriptor by 11.3 times as much.
inline Descriptor changed(const Descriptor &descriptor, int by, Random *random) {
  Descriptor out;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int value = descriptor.bytes[i];
    const bool up = value < by || (value + by <= 255 && random->below(2) == 1);
    out.bytes[i] = static_cast<uint8_t>(up ? value + by : value - by);
  }
  return out;
}

// The room in another recording: triangulated anew, described anew, in another world frame.
inline host::PointModel seenAgain(host::PointModel model, uint64_t seed, const Rigid &other_from_world = {},
                                  double noise_m = 0.005, int by = 15) {
  Random random(seed);
  for (host::ModelPoint &point : model.points) {
    point.position_m = other_from_world * (point.position_m + noise_m * normalVector(&random));
    point.descriptor = changed(point.descriptor, by, &random);
  }
  return model;
}

inline host::PointModel joined(host::PointModel a, const host::PointModel &b) {
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  return a;
}

// Points [first, first + count).
inline host::PointModel part(const host::PointModel &model, size_t first, size_t count) {
  return {{model.points.begin() + static_cast<ptrdiff_t>(first),
           model.points.begin() + static_cast<ptrdiff_t>(first + count)}};
}

inline Rigid otherWorld() {
  Random random(8);
  return {randomRotation(&random), {-5, 2, 1}};
}

// A later recording, in another world, of the room's first points and of others.
inline host::PointModel seenLater(const host::PointModel &room, size_t points, const host::PointModel &others,
                                  uint64_t seed = 3) {
  return seenAgain(joined(part(room, 0, points), others), seed, otherWorld());
}

}  // namespace sphc::test
