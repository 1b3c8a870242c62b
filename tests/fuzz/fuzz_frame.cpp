#include <cmath>
#include <cstring>

#include "tests/fuzz/targets.h"
#include "tests/support/session.h"

namespace sphc::fuzz {
namespace {

// Small images, so that a run is short.
sphc_config smallConfig() {
  sphc_config config = test::sceneConfig();
  config.color_camera = test::pinhole(96, 72, 80);
  config.depth_camera = test::pinhole(48, 40, 36);
  config.max_keypoints = 64;
  config.max_iterations = 200;
  return config;
}

test::Session &session() {
  static test::Session *instance = new test::Session(smallConfig(), 0.7);
  return *instance;
}

class Reader {
 public:
  Reader(const uint8_t *data, size_t bytes) : data_(data), bytes_(bytes) {}
  uint32_t take32() {
    uint8_t four[4] = {};
    for (uint8_t &byte : four) byte = next();
    uint32_t value;
    std::memcpy(&value, four, 4);
    return value;
  }
  uint8_t next() { return bytes_ ? (--bytes_, *data_++) : uint8_t{0}; }

 private:
  const uint8_t *data_;
  size_t bytes_;
};

// Mostly the right value, at times whatever the bytes say.
uint32_t around(uint32_t right, Reader *reader) {
  const uint8_t how = reader->next();
  if (how < 200) return right;
  return how < 230 ? right + reader->next() - 128 : reader->take32();
}

bool fits(const sphc_image &image, size_t bytes) {  // else the caller would lie about what the library may read
  return uint64_t{image.stride_bytes} * image.height <= bytes;
}

bool isFilled(const sphc_result &result) {
  double sum = 0;
  for (double q : result.camera_from_map.q_wxyz) sum += q * q;
  for (double t : result.camera_from_map.t_m) sum += 0 * t;
  for (double c : result.covariance) sum += 0 * c;
  return std::abs(sum - 1) < 1e-6;  // NaN fails
}

}  // namespace

void frame(const uint8_t *data, size_t bytes) {
  Reader reader(data, bytes);
  std::vector<uint8_t> color(320 * 96);
  std::vector<uint16_t> depth(160 * 60);
  sphc_frame f = {};
  f.struct_size = around(sizeof f, &reader);
  f.color.width = around(96, &reader);
  f.color.height = around(72, &reader);
  f.color.format = static_cast<sphc_format>(around(1 + reader.next() % 3, &reader));
  f.color.stride_bytes = around(f.color.format == SPHC_FORMAT_GRAY8 ? 96 : 288, &reader);
  f.depth.width = around(48, &reader);
  f.depth.height = around(40, &reader);
  f.depth.format = static_cast<sphc_format>(around(SPHC_FORMAT_DEPTH16, &reader));
  f.depth.stride_bytes = around(96, &reader);
  const uint8_t shift = reader.next() % 8;
  for (uint8_t &byte : color) byte = reader.next();
  for (uint16_t &value : depth) value = static_cast<uint16_t>(reader.next() | (reader.next() << 8));
  f.color.data = color.data();
  f.depth.data = reinterpret_cast<const uint8_t *>(depth.data()) + (shift == 1 ? 1 : 0);
  if (!fits(f.color, color.size()) || !fits(f.depth, 2 * depth.size() - 1)) return;

  sphc_result result;
  const sphc_status status = session().process(f, &result);
  if (status == SPHC_OK || status == SPHC_NOT_LOCALIZED) {
    if (!isFilled(result) || result.inliers > result.keypoints)
      broken("a result has finite numbers that fit together");
  } else if (status > 0 || !sphc_localizer_message(session().localizer())[0]) {
    broken("a refusal is a failure that explains itself");
  }
  if (!session().state().guardsIntact() || !session().scratch().guardsIntact())
    broken("the localizer keeps inside its memory");
}

}  // namespace sphc::fuzz
