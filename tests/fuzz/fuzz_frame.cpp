#include <iterator>

#include "tests/fuzz/arguments.h"
#include "tests/fuzz/targets.h"
#include "tests/support/session.h"

namespace sphc::fuzz {
namespace {

constexpr sphc_format kDepthFormats[] = {SPHC_FORMAT_DEPTH16, SPHC_FORMAT_DEPTH12P, SPHC_FORMAT_RANGE16,
                                         SPHC_FORMAT_RANGE_F32};
constexpr uint32_t kAmplitudeMin = 40;  // of the sessions with ranges

bool hasAmplitude(uint32_t kind) { return kind >= 2; }

// One for each format of depth.
test::Session &sessionOf(uint32_t kind) {
  static test::Session *instances[4] = {};
  if (instances[kind]) return *instances[kind];
  sphc_localizer_config config = smallConfig();
  config.depth_format = kDepthFormats[kind];
  config.amplitude_min = hasAmplitude(kind) ? kAmplitudeMin : 0;
  instances[kind] = new test::Session(config, 0.7);
  instances[kind]->setParameter(SPHC_PARAMETER_MAX_ITERATIONS, 200);
  return *instances[kind];
}

constexpr sphc_format kColorFormats[] = {
    SPHC_FORMAT_GRAY8,   SPHC_FORMAT_RGB8,        SPHC_FORMAT_BGR8,         SPHC_FORMAT_RGBA8,
    SPHC_FORMAT_NV12,    SPHC_FORMAT_UYVY,        SPHC_FORMAT_GRAY10,       SPHC_FORMAT_GRAY10P,
    SPHC_FORMAT_GRAY12P, SPHC_FORMAT_BAYER_RGGB8, SPHC_FORMAT_BAYER_GBRG12, SPHC_FORMAT_BAYER_GRBG10P};

bool fits(const sphc_image &image, size_t bytes) {  // else the caller would lie about what the library may read
  return uint64_t{image.stride_bytes} * image.height <= bytes;
}

}  // namespace

void frame(const uint8_t *data, size_t bytes) {
  Reader reader(data, bytes);
  std::vector<uint8_t> color(320 * 96);
  std::vector<uint16_t> depth(160 * 60);
  Roomy<sphc_localizer_frame> roomy;
  sphc_localizer_frame &f = roomy.its;
  f.struct_size = around(sizeof f, &reader);
  f.color.width = around(96, &reader);
  f.color.height = around(72, &reader);
  const sphc_format color_format = kColorFormats[reader.next() % std::size(kColorFormats)];
  f.color.format = static_cast<sphc_format>(around(static_cast<uint32_t>(color_format), &reader));
  f.color.stride_bytes = around(sphc_format_row_bytes(color_format, 96), &reader);
  f.depth.width = around(48, &reader);
  f.depth.height = around(40, &reader);
  const uint8_t shift = reader.next();
  const uint32_t kind = shift / 8 % 4;
  f.depth.format = static_cast<sphc_format>(around(static_cast<uint32_t>(kDepthFormats[kind]), &reader));
  f.depth.stride_bytes = around(sphc_format_row_bytes(kDepthFormats[kind], 48), &reader);
  f.color_time_ns = static_cast<int64_t>((uint64_t{around(0, &reader)} << 32) | reader.take32());
  f.depth_time_ns = f.color_time_ns;
  Roomy<sphc_localizer_prior> prior;
  prior.its = priorFrom(&reader);
  if (reader.next() & 1) f.prior = &prior.its;
  roomy.behind[reader.next()] = prior.behind[reader.next()] = reader.next() % 2;
  for (uint8_t &byte : color) byte = reader.next();
  for (uint16_t &value : depth) value = static_cast<uint16_t>(reader.next() | (reader.next() << 8));
  f.color.data = color.data();
  f.depth.data = reinterpret_cast<const uint8_t *>(depth.data()) + (shift % 8 == 1 ? 1 : 0);
  if (hasAmplitude(kind) != (shift % 8 == 2)) {  // mostly as the config says
    f.amplitude = {color.data(), 48, 40, 96, kind == 2 ? SPHC_FORMAT_GRAY8 : SPHC_FORMAT_GRAY12};
    f.amplitude.width = around(48, &reader);
    f.amplitude.stride_bytes = around(96, &reader);
  }
  if (!fits(f.color, color.size()) || !fits(f.depth, 2 * depth.size() - 1) || !fits(f.amplitude, color.size()))
    return;

  sphc_localizer_result result;
  const sphc_status status = sessionOf(kind).process(f, &result);
  if (status == SPHC_OK || status == SPHC_NOT_LOCALIZED) {
    if (!isFilled(result) || result.inliers > result.keypoints)
      broken("a result has finite numbers that fit together");
    if (status == SPHC_OK) accept();
  } else if (status > 0 || !sphc_localizer_message(sessionOf(kind).localizer())[0]) {
    broken("a refusal is a failure that explains itself");
  }
  if (!sessionOf(kind).state().guardsIntact() || !sessionOf(kind).scratch().guardsIntact())
    broken("the localizer keeps inside its memory");
}

}  // namespace sphc::fuzz
