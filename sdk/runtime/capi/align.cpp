#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/config_copy.h"
#include "runtime/capi/defaults.h"
#include "runtime/capi/format.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"
#include "runtime/capi/translate.h"

namespace {

using sphc::Arena;
using sphc::DenseAligner;
using sphc::DenseConfig;
using sphc::DepthReader;
using sphc::DepthReaderConfig;
using sphc::MessageWriter;

constexpr size_t kAlignerBytes = sizeof(sphc_aligner);  // a multiple of the arena's alignment

DenseConfig denseConfig(const sphc_aligner_config &config) {
  DenseConfig dense;
  dense.color = sphc::Camera(config.rig.color_camera);
  dense.depth = sphc::Camera(config.rig.depth_camera);
  dense.color_from_depth = sphc::rigidFromC(config.rig.color_from_depth);
  dense.sensor =
      sphc::sensorReadAs(config.depth_format, {config.rig.depth_unit_m, config.depth_min_m, config.depth_max_m,
                                               config.depth_sigma_m, config.depth_sigma_per_m2});
  dense.out_unit_m = config.aligned_unit_m > 0 ? config.aligned_unit_m : config.rig.depth_unit_m;
  return dense;
}

DepthReaderConfig readerConfig(const sphc_aligner_config &config) {
  DepthReaderConfig reader;
  reader.camera = sphc::Camera(config.rig.depth_camera);
  reader.unit_m = config.rig.depth_unit_m;
  reader.layout = sphc::depthLayoutFrom(config.depth_format);
  return reader;
}

// An aligner has no scratch: all of it is state.
void layout(const DenseConfig &dense, const DepthReaderConfig &reader, Arena &state, sphc_aligner *aligner) {
  DepthReader::layout(reader, state, state, aligner ? &aligner->reader : nullptr);
  DenseAligner::layout(dense, state, aligner ? &aligner->aligner : nullptr);
}

size_t bytesOf(const DenseConfig &dense, const DepthReaderConfig &reader) {
  Arena arena;
  layout(dense, reader, arena, nullptr);
  return kAlignerBytes + arena.used();
}

// One of the images to write: is its stride sound?
sphc_status checkPlane(const char *name, const void *data, uint32_t stride, uint32_t row, uint32_t pixel,
                       sphc_message *message) {
  if (!data) return SPHC_OK;
  if (stride < row || stride > SPHC_STRIDE_MAX_BYTES || stride % pixel) {
    MessageWriter(message) << "aligned." << name << "_stride_bytes is " << stride << "; a row has " << row
                           << " bytes" << (pixel > 1 ? " and the stride must be even" : "");
    return SPHC_E_IMAGE;
  }
  if (reinterpret_cast<uintptr_t>(data) % pixel) {
    MessageWriter(message) << "aligned." << name << " is odd; align it to " << pixel << " bytes";
    return SPHC_E_IMAGE;
  }
  return SPHC_OK;
}

sphc_status readAligned(const sphc_aligned *aligned, uint32_t width, sphc_aligned *copy, sphc_message *message) {
  sphc_status status = sphc::readStruct("aligned", aligned, copy, message);
  if (status == SPHC_OK) status = checkPlane("depth", copy->depth, copy->depth_stride_bytes, 2 * width, 2, message);
  if (status == SPHC_OK) status = checkPlane("mask", copy->mask, copy->mask_stride_bytes, width, 1, message);
  if (status == SPHC_OK)
    status = checkPlane("confidence", copy->confidence, copy->confidence_stride_bytes, width, 1, message);
  return status;
}

}  // namespace

sphc_status sphc_aligner_config_init(sphc_aligner_config *config, size_t struct_size) {
  return sphc::initStruct(sphc::defaultAlignerConfig(), struct_size, config);
}

sphc_status sphc_aligner_memory(const sphc_aligner_config *config, sphc_memory *memory, sphc_message *message) {
  sphc_aligner_config checked;
  const sphc_status status = sphc::readAlignerConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  return sphc::giveMemory({bytesOf(denseConfig(checked), readerConfig(checked)), 0, sphc::kArenaAlignment, 0},
                          memory, message);
}

sphc_status sphc_aligner_init(void *memory, size_t memory_bytes, const sphc_aligner_config *config,
                              sphc_aligner **aligner, sphc_message *message) {
  sphc_aligner_config checked;
  sphc_status status = sphc::readAlignerConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  if (!aligner) {
    MessageWriter(message) << "aligner is null; give a pointer to set";
    return SPHC_E_ARGUMENT;
  }
  const DenseConfig dense = denseConfig(checked);
  const DepthReaderConfig reader = readerConfig(checked);
  const size_t needed = bytesOf(dense, reader);
  status = sphc::checkMemory(memory, memory_bytes, needed, sphc::kArenaAlignment, "aligner", message);
  if (status != SPHC_OK) return status;
  auto *made = new (memory) sphc_aligner();
  Arena arena(static_cast<unsigned char *>(memory) + kAlignerBytes);
  layout(dense, reader, arena, made);
  made->reader.init(reader);
  made->aligner.init(dense);
  made->color = checked.rig.color_camera;
  made->depth = checked.rig.depth_camera;
  made->depth_format = sphc::depthFormatOf(checked.depth_format);
  *aligner = made;
  return SPHC_OK;
}

sphc_status sphc_aligner_process(sphc_aligner *aligner, const sphc_image *depth, const sphc_aligned *aligned) {
  if (!aligner) return SPHC_E_ARGUMENT;
  aligner->message.text[0] = '\0';
  if (!depth) {
    MessageWriter(&aligner->message) << "depth is null; give an image";
    return SPHC_E_ARGUMENT;
  }
  sphc_status status = sphc::checkImage("depth", *depth, aligner->depth,
                                        {aligner->depth_format, "config.depth_format"}, &aligner->message);
  sphc_aligned to = {};
  if (status == SPHC_OK) status = readAligned(aligned, aligner->color.width, &to, &aligner->message);
  if (status != SPHC_OK) return status;
  aligner->aligner.process(aligner->reader.read(sphc::bytesOf(*depth), {}),
                           {to.depth, to.mask, to.confidence, to.depth_stride_bytes / 2, to.mask_stride_bytes,
                            to.confidence_stride_bytes});
  return SPHC_OK;
}

const char *sphc_aligner_message(const sphc_aligner *aligner) {
  return aligner ? aligner->message.text : "aligner is null";
}

void sphc_aligner_fini(sphc_aligner **aligner) {
  if (aligner) *aligner = nullptr;
}
