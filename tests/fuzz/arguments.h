// Arguments of the C interface, made of bytes: mostly sound ones, so that calls get far.
#pragma once
#include <cmath>
#include <cstring>

#include "tests/support/session.h"

namespace sphc::fuzz {

// Small images, so that a run is short.
inline sphc_localizer_config smallConfig() {
  sphc_localizer_config config = test::sceneConfig();
  config.rig.color_camera = test::pinhole(96, 72, 80);
  config.rig.depth_camera = test::pinhole(48, 40, 36);
  config.max_keypoints = 64;
  return config;
}

class Reader {
 public:
  Reader(const uint8_t *data, size_t bytes) : data_(data), bytes_(bytes) {}
  uint32_t take32() {
    uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value |= uint32_t{next()} << 8 * i;
    return value;
  }
  bool isAtEnd() const { return bytes_ == 0; }
  uint8_t next() { return bytes_ ? (--bytes_, *data_++) : uint8_t{0}; }

 private:
  const uint8_t *data_;
  size_t bytes_;
};

// Mostly the right value, at times whatever the bytes say.
inline uint32_t around(uint32_t right, Reader *reader) {
  const uint8_t how = reader->next();
  if (how < 200) return right;
  return how < 230 ? right + reader->next() - 128 : reader->take32();
}

// Mostly small numbers, at times whatever the bytes say.
inline double anyNumber(Reader *reader) {
  if (reader->next() < 220) return (reader->next() - 128) / 64.0;
  const uint64_t bits = (uint64_t{reader->take32()} << 32) | reader->take32();
  double value;
  std::memcpy(&value, &bits, 8);
  return value;
}

inline void fill(sphc_rigid *pose, Reader *reader) {
  pose->q_wxyz[0] = 1;
  if (reader->next() < 50)
    for (double &q : pose->q_wxyz) q = anyNumber(reader);
  for (double &t : pose->t_m) t = anyNumber(reader);
}

inline sphc_localizer_prior priorFrom(Reader *reader) {
  sphc_localizer_prior prior = {};
  prior.struct_size = around(sizeof prior, reader);
  prior.flags = around(reader->next() % 8, reader);
  prior.map_id = around(0, reader);
  fill(&prior.camera_from_map, reader);
  fill(&prior.odometry_from_camera, reader);
  for (double *v : {prior.up_camera, prior.up_map})
    for (int i = 0; i < 3; ++i) v[i] = anyNumber(reader);
  for (double *sigma : {&prior.rotation_sigma_rad, &prior.translation_sigma_m, &prior.up_sigma_rad,
                        &prior.odometry_rotation_sigma_rad, &prior.odometry_translation_sigma_m})
    *sigma = anyNumber(reader);
  return prior;
}

// A caller's struct of any size that struct_size may tell: what lies behind ours is the caller's too.
template <typename T>
struct Roomy {
  T its = {};
  uint8_t behind[4096] = {};
};

inline bool isFilled(const sphc_localizer_result &result) {
  double sum = 0;
  for (double q : result.camera_from_map.q_wxyz) sum += q * q;
  for (double t : result.camera_from_map.t_m) sum += 0 * t;
  for (double c : result.covariance) sum += 0 * c;
  return std::abs(sum - 1) < 1e-6;  // NaN fails
}

}  // namespace sphc::fuzz
