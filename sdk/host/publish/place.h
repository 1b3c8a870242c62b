// A place as its owner knows it: what was published of it, and the truth behind.  Never leaves the owner's hands.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/import/point_model.h"
#include "runtime/map/layout.h"

namespace sphc::host {

using MapId = std::array<uint8_t, 16>;

// A published point.  None of this changes once it is published.
struct PlacePoint {
  ModelPoint seen;  // position in the place's frame
  // As published; those of a real point are its own.
  PackedDirection direction;
  Descriptor descriptor;
  bool real;
  uint32_t release;  // the first that had it, counted from 1
};

// A map file that was written.  It holds all points of this and of the releases before it.
struct Release {
  MapId map_id;
  uint32_t crc32;  // of the file
  uint32_t points;
  int64_t time_s;  // since 1970
};

struct Place {
  uint32_t number = 0;                 // in its ledger, from 1
  Vector3 centre_m = Vector3::Zero();  // in the place's frame, which is the world of its first recording
  double eta = 0;
  std::string strategy;    // of the fakes
  double fake_option = 0;  // of FakeOptions, that of the strategy; 0: released before ledgers kept it
  sphc_band band = SPHC_BAND_VISIBLE;
  std::vector<PlacePoint> points;  // in the order in which they were published
  std::vector<Release> releases;
};

}  // namespace sphc::host
