#include <cmath>
#include <cstring>
#include <memory>

#include "tests/fuzz/targets.h"
#include "tests/support/map_bytes.h"
#include "tests/support/session.h"

namespace sphc::fuzz {
namespace {

void readAll(const sphc_map *map, size_t bytes) {
  sphc_map_info info = {};
  info.struct_size = sizeof info;
  if (sphc_map_get_info(map, &info) != SPHC_OK || info.file_bytes != bytes)
    broken("an accepted map tells its size");
  for (uint32_t i = 0; i < info.point_count; ++i) {
    double d[3];
    if (sphc_map_direction(map, i, d) != SPHC_OK) broken("every point has a direction");
    if (!(std::abs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1) < 1e-5)) broken("every direction has unit length");
  }
}

// Small, so that a run is short; every keypoint matches something.  Not named as that of arguments.h, which it
// would hide from the other files of a unity build.
sphc_localizer_config mapConfig() {
  sphc_localizer_config config = test::sceneConfig();
  config.rig.color_camera = test::pinhole(128, 96, 107);
  config.rig.depth_camera = test::pinhole(64, 48, 48);
  config.max_keypoints = 64;
  return config;
}

void localizeIn(const sphc_map *map) {
  static const sphc_localizer_config of_visible = mapConfig();
  sphc_map_info info = {};
  info.struct_size = sizeof info;
  sphc_map_get_info(map, &info);
  sphc_localizer_config config = of_visible;
  config.color_band = info.band;
  static const auto frame = test::sceneFrame(of_visible, 0);
  static const auto sizes = [] {
    sphc_memory need = {};
    if (sphc_localizer_memory(&of_visible, &need, nullptr) != SPHC_OK) broken("the config is good");
    return need;
  }();
  test::GuardedMemory state(sizes.state_bytes, sizes.alignment), scratch(sizes.scratch_bytes, sizes.alignment);
  sphc_localizer *localizer = nullptr;
  if (sphc_localizer_init(state.data(), state.size(), scratch.data(), scratch.size(), &config, &localizer,
                          nullptr) != SPHC_OK ||
      sphc_localizer_set_map(localizer, 0, map) != SPHC_OK ||
      sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_MAX_ITERATIONS, 50) != SPHC_OK ||
      sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_MAX_RATIO, 1) != SPHC_OK)
    broken("an accepted map can be localized in");
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  if (sphc_localizer_process(localizer, &frame->frame, &result) < 0) broken("a good frame is taken");
  sphc_localizer_fini(&localizer);
  if (!state.guardsIntact() || !scratch.guardsIntact()) broken("the localizer keeps inside its memory");
}

void open(const std::vector<uint8_t> &file, bool localizes) {
  // Exactly as many bytes as the file has, so that a sanitizer sees a step too far.
  const std::unique_ptr<uint64_t[]> copy(new uint64_t[file.size() / 8 + 1]);
  uint8_t *start = reinterpret_cast<uint8_t *>(copy.get());
  if (!file.empty()) std::memcpy(start, file.data(), file.size());
  alignas(64) uint8_t memory[1024];
  sphc_map *map = nullptr;
  sphc_message message = {};
  const sphc_status status = sphc_map_init(memory, sizeof memory, start, file.size(), &map, &message);
  if (status == SPHC_OK) {
    accept();
    readAll(map, file.size());
    if (localizes) localizeIn(map);
    sphc_map_fini(&map);
  } else if (status > 0 || map || !message.text[0]) {
    broken("a refusal is a failure that explains itself");
  }
}

void openAsIsAndSigned(const uint8_t *data, size_t bytes, bool localizes) {
  std::vector<uint8_t> file(data, data + bytes);
  open(file, localizes);
  // And with checksums that fit, to come past them.
  constexpr uint32_t kSections = 6;
  if (file.size() < 64 + 32 * kSections || test::get32(file, 28) != kSections) return;
  for (uint32_t section = 0; section < kSections; ++section) {
    const uint64_t offset = test::get64(file, 72 + 32 * section), length = test::get64(file, 80 + 32 * section);
    if (offset <= file.size() && length <= file.size() - offset) test::signSection(&file, section);
  }
  test::signHeader(&file);
  open(file, localizes);
}

}  // namespace

void map(const uint8_t *data, size_t bytes) { openAsIsAndSigned(data, bytes, true); }

void mapRead(const uint8_t *data, size_t bytes) { openAsIsAndSigned(data, bytes, false); }

}  // namespace sphc::fuzz
