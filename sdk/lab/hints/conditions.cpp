#include "lab/hints/conditions.h"

#include <spherecloud/spherecloud.hpp>

#include <algorithm>
#include <cmath>

#include "lab/common/normal.h"

namespace sphc::host {
namespace {

// Full light is 1: 5000 photons, and 8 for the noise of reading; on a tone of 127 about 2 of 255.
constexpr double kPhotonNoise = 2e-4, kReadNoise = 0.0016;
constexpr double kTypicalDepthM = 2;  // of what moves past the camera

uint64_t seedOf(const Shot &shot) { return static_cast<uint64_t>(shot.color_time_ns); }

std::function<void(Sequence *)> exposed(const ExposureSetting &exposure) {
  return [exposure](Sequence *sequence) {
    for (Shot &shot : sequence->shots) expose(exposure, seedOf(shot), &shot.color);
  };
}

struct Flow {
  double x = 1, y = 0;
};

// How the image's middle moves from one shot to another; any length.
Flow flowBetween(const Shot &before, const Shot &after) {
  if (!before.world_from_camera || !after.world_from_camera) return {};
  const sphc_rigid now_from_world = spherecloud::inverse(*after.world_from_camera);
  sphc_rigid moved;
  sphc_rigid_compose(&now_from_world, &*before.world_from_camera, &moved);
  const double *q = moved.q_wxyz, *t = moved.t_m, sign = q[0] < 0 ? -2 : 2;  // a point ahead: turn x (0, 0, 1)
  return {sign * q[2] + t[0] / kTypicalDepthM, -sign * q[1] + t[1] / kTypicalDepthM};
}

// As long an exposure as that takes; the noise is that of the camera, which motion does not mix.
std::function<void(Sequence *)> blurredBy(double length_px) {
  return [length_px](Sequence *sequence) {
    std::vector<Shot> &shots = sequence->shots;
    for (size_t i = 0; i < shots.size(); ++i) {
      const Flow flow = flowBetween(shots[i ? i - 1 : 0], shots[i ? i : std::min<size_t>(1, shots.size() - 1)]);
      blurAlong(flow.x, flow.y, length_px, *sequence, &shots[i]);
      expose({}, seedOf(shots[i]), &shots[i].color);
    }
  };
}

// Walls of one colour: a share of the contrast is left, under the noise of the camera.
std::function<void(Sequence *)> flattened(double contrast) {
  return [contrast](Sequence *sequence) {
    for (Shot &shot : sequence->shots) {
      double sum = 0;
      for (const uint8_t value : shot.color) sum += value;
      const double mean = sum / static_cast<double>(shot.color.size());
      for (uint8_t &value : shot.color)
        value = static_cast<uint8_t>(std::clamp(mean + contrast * (value - mean) + 0.5, 0.0, 255.0));
      expose({}, seedOf(shot), &shot.color);
    }
  };
}

std::function<void(Sequence *)> seenUpTo(double range_m) {
  return [range_m](Sequence *sequence) {
    for (Shot &shot : sequence->shots)
      for (uint16_t &depth : shot.depth)
        if (depth * sequence->rig.depth_unit_m > range_m) depth = 0;
  };
}

}  // namespace

void expose(const ExposureSetting &exposure, uint64_t seed, std::vector<uint8_t> *values) {
  Random random(seed);
  const double read2 = kReadNoise * kReadNoise;
  for (uint8_t &value : *values) {
    const double light = exposure.light * value * value / (255.0 * 255.0);
    const double noisy = exposure.gain * (light + normalOf(&random) * std::sqrt(read2 + kPhotonNoise * light));
    value = static_cast<uint8_t>(255 * std::sqrt(std::clamp(noisy, 0.0, 1.0)) + 0.5);
  }
}

void blurAlong(double x, double y, double length_px, const Sequence &sequence, Shot *shot) {
  const double length = std::hypot(x, y);
  if (!(length > 0)) {
    x = 1;
    y = 0;
  } else {
    x /= length;
    y /= length;
  }
  const auto w = static_cast<int32_t>(sequence.colorWidth()), h = static_cast<int32_t>(sequence.colorHeight());
  const auto c = static_cast<int32_t>(sequence.channels()), taps = std::max(1, static_cast<int32_t>(length_px));
  std::vector<float> sum(shot->color.size(), 0.0f);
  for (int32_t tap = 0; tap < taps; ++tap) {
    const double along = (tap + 0.5) / taps * length_px - length_px / 2;
    const auto dx = static_cast<int32_t>(std::lround(along * x)), dy = static_cast<int32_t>(std::lround(along * y));
    size_t out = 0;
    for (int32_t v = 0; v < h; ++v)
      for (int32_t u = 0; u < w; ++u) {
        const int32_t from = (std::clamp(v + dy, 0, h - 1) * w + std::clamp(u + dx, 0, w - 1)) * c;
        for (int32_t k = 0; k < c; ++k, ++out) {
          const auto value = static_cast<float>(shot->color[static_cast<size_t>(from + k)]);
          sum[out] += value * value;
        }
      }
  }
  for (size_t i = 0; i < sum.size(); ++i)
    shot->color[i] = static_cast<uint8_t>(std::sqrt(sum[i] / static_cast<float>(taps)) + 0.5f);
}

std::vector<HintCondition> hintConditions() {
  return {{"healthy", [](Sequence *) {}, 0},
          {"a 25th of the light, amplified", exposed({0.04, 6}), SPHC_HINT_TOO_DARK},
          {"a 100th of the light, amplified", exposed({0.01, 25}), SPHC_HINT_TOO_DARK},
          {"a 400th of the light", exposed({0.0025, 1}), SPHC_HINT_TOO_DARK},
          {"blurred by 12 px", blurredBy(12), SPHC_HINT_TOO_FAST},
          {"blurred by 24 px", blurredBy(24), SPHC_HINT_TOO_FAST},
          {"blurred by 48 px", blurredBy(48), SPHC_HINT_TOO_FAST},
          {"a 20th of the contrast", flattened(0.05), SPHC_HINT_TOO_PLAIN},
          {"depth up to 0.7 m", seenUpTo(0.7), SPHC_HINT_NO_DEPTH_IN_RANGE}};
}

}  // namespace sphc::host
