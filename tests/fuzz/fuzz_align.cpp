#include <cstring>

#include "tests/fuzz/targets.h"
#include "tests/support/session.h"

namespace sphc::fuzz {
namespace {

constexpr uint32_t kMostWidth = 40, kMostHeight = 32;

// The bytes of a config, with what would only end it at once put right: sizes stay small, and so does a run.
sphc_aligner_config configFrom(const uint8_t *data, size_t bytes) {
  sphc_aligner_config config = {};
  std::memcpy(&config, data, bytes < sizeof config ? bytes : sizeof config);
  config.struct_size = sizeof config;
  for (sphc_camera *camera : {&config.rig.color_camera, &config.rig.depth_camera}) {
    camera->width = 16 + camera->width % (kMostWidth - 15);
    camera->height = 16 + camera->height % (kMostHeight - 15);
  }
  return config;
}

void check(const sphc_aligner_config &config, const std::vector<uint16_t> &depth, const std::vector<uint8_t> &mask,
           const std::vector<uint8_t> &confidence) {
  for (size_t i = 0; i < size_t{config.rig.color_camera.width} * config.rig.color_camera.height; ++i) {
    if (mask[i] > SPHC_ALIGNED_OCCLUDED) broken("a pixel is one of four kinds");
    const bool has = mask[i] == SPHC_ALIGNED_MEASURED || mask[i] == SPHC_ALIGNED_FILLED;
    if (!has && (depth[i] || confidence[i])) broken("a pixel without depth has depth 0 and confidence 0");
    if (has && !depth[i]) broken("a pixel with depth has one");
  }
}

}  // namespace

void align(const uint8_t *data, size_t bytes) {
  const sphc_aligner_config config = configFrom(data, bytes);
  sphc_memory need = {};
  sphc_message message = {};
  const sphc_status status = sphc_aligner_memory(&config, &need, &message);
  if (status != SPHC_OK) {
    if (status > 0 || !message.text[0]) broken("a refusal is a failure that explains itself");
    return;
  }
  test::GuardedMemory memory(need.state_bytes, need.alignment);
  sphc_aligner *aligner = nullptr;
  if (sphc_aligner_init(memory.data(), memory.size(), &config, &aligner, &message) != SPHC_OK)
    broken("what can be measured can be made");
  // The rest of the bytes are pixels, again and again.
  const sphc_format format = config.depth_format ? config.depth_format : SPHC_FORMAT_DEPTH16;
  const uint32_t row_bytes = (sphc_format_row_bytes(format, config.rig.depth_camera.width) + 3) / 4 * 4;
  std::vector<uint16_t> raw(size_t{row_bytes} * config.rig.depth_camera.height / 2);
  const size_t rest = bytes > sizeof config ? bytes - sizeof config : 0;
  for (size_t i = 0; i < raw.size() && rest > 1; ++i)
    std::memcpy(&raw[i], data + sizeof config + (2 * i) % (rest - 1), sizeof raw[i]);
  const uint32_t width = config.rig.color_camera.width;
  const size_t pixels = size_t{width} * config.rig.color_camera.height;
  std::vector<uint16_t> depth(pixels);
  std::vector<uint8_t> mask(pixels), confidence(pixels);
  const sphc_image image = {raw.data(), config.rig.depth_camera.width, config.rig.depth_camera.height, row_bytes,
                            format};
  const sphc_aligned aligned = {sizeof aligned, 2 * width,        width, width, depth.data(),
                                mask.data(),    confidence.data()};
  if (sphc_aligner_process(aligner, &image, &aligned) != SPHC_OK) broken("a fitting image is aligned");
  accept();
  check(config, depth, mask, confidence);
  if (!memory.guardsIntact()) broken("no byte beyond the memory handed over is touched");
}

}  // namespace sphc::fuzz
