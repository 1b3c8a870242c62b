// Releases of made-up rooms, as attackers see them and as the owner knows them.
#pragma once
#include "host/audit/attack/published.h"
#include "host/audit/score/truth.h"
#include "host/build/release.h"
#include "tests/support/made_up_model.h"

namespace sphc::test {

struct MadeUpRelease {
  host::Place place;
  std::vector<uint8_t> file;
  host::Published map;
  std::vector<host::EntryTruth> truth;
};

inline MadeUpRelease released(const host::PointModel &model, uint8_t key, double eta,
                              const std::vector<host::Place> &own = {}) {
  const auto strategy = host::gaussianFakes();
  host::ReleaseRequest request;
  request.own = own;
  request.key = {key};
  request.strategy = strategy.get();
  request.eta = eta;
  host::NewRelease made = host::makeRelease(model, request);
  MadeUpRelease release = {std::move(made.place), std::move(made.file), {}, {}};
  release.map = host::publishedIn(release.file);
  release.truth = host::truthOf(release.map, release.place);
  return release;
}

inline Rigid otherWorld() {
  Random random(8);
  return {randomRotation(&random), {-5, 2, 1}};
}

}  // namespace sphc::test
