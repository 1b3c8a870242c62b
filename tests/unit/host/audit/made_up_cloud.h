// Clouds in which real points lie in clusters of lookalikes, and fakes anywhere, or in nothing different from them.
#pragma once
#include "host/audit/score/known_cloud.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {

inline Descriptor nearTo(const Descriptor &descriptor, Random *random) {
  Descriptor near = descriptor;
  for (uint8_t &byte : near.bytes) byte = static_cast<uint8_t>(byte / 2 + random->below(64));
  return near;
}

// `tell`: fakes lie anywhere; otherwise where real ones do.
inline KnownCloud makeUpCloud(bool tell, uint64_t seed) {
  Random random(seed);
  KnownCloud cloud;
  for (int cluster = 0; cluster < 12; ++cluster) {
    const Vector3 middle = test::randomDirection(&random);
    const Descriptor common = test::randomDescriptor(&random);
    for (int i = 0; i < 30; ++i) {
      const bool real = i % 3 == 0;
      const Vector3 beside = (middle + 0.05 * test::normalVector(&random)).normalized();
      cloud.published.directions.push_back(real || !tell ? beside : test::randomDirection(&random));
      cloud.published.descriptors.push_back(nearTo(common, &random));
      cloud.real.push_back(real);
    }
  }
  return cloud;
}

}  // namespace sphc::host
