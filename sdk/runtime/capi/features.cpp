#include <algorithm>
#include <cstring>
#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/config_copy.h"
#include "runtime/capi/frame_copy.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"
#include "runtime/capi/translate.h"
#include "runtime/stages/features/extractor.h"

// A caller's keypoint is one of ours, so they are read and written in place.
static_assert(sizeof(sphc_keypoint) == sizeof(sphc::Keypoint));
static_assert(offsetof(sphc_keypoint, scale_px) == offsetof(sphc::Keypoint, scale_px) &&
              offsetof(sphc_keypoint, angle_rad) == offsetof(sphc::Keypoint, orientation_rad) &&
              offsetof(sphc_keypoint, response) == offsetof(sphc::Keypoint, response));
static_assert(SPHC_DESCRIPTOR_BYTES == sphc::kDescriptorBytes);

namespace {

using sphc::Arena;
using sphc::FrameFeatures;
using sphc::Keypoint;
using sphc::LocalizerConfig;
using sphc::MessageWriter;

constexpr size_t kFeaturesBytes = sizeof(sphc_features);  // a multiple of the arena's alignment
constexpr float kMostScalePx = 8192, kMostAngleRad = 7;   // a turn and what rounding adds, either way

size_t bytesFor(const LocalizerConfig &config) {
  Arena arena;
  FrameFeatures::layout(config, arena, nullptr);
  return kFeaturesBytes + arena.used();
}

Keypoint keypointAt(const sphc_features_arrays &arrays, uint32_t i) {
  Keypoint keypoint;
  std::memcpy(&keypoint,
              reinterpret_cast<const uint8_t *>(arrays.keypoints) + size_t{i} * arrays.keypoint_stride_bytes,
              sizeof keypoint);
  return keypoint;
}

uint32_t cameraAt(const sphc_features_arrays &arrays, uint32_t i) { return arrays.cameras ? arrays.cameras[i] : 0; }

bool isWithin(float value, float low, float high) { return value >= low && value <= high; }

// What is wrong with a keypoint, or null.
const char *faultOf(const Keypoint &k, uint32_t camera, const sphc::ImageSizes &images) {
  if (camera >= images.count)
    return " is of a camera that the config does not have; 0 is the colour camera, i is config.cameras[i - 1]";
  const sphc::ImageSize &image = images.of[camera];
  if (!isWithin(k.x_px, 0, static_cast<float>(image.width)) ||
      !isWithin(k.y_px, 0, static_cast<float>(image.height)))
    return " lies outside the image; give pixels of its camera's image";
  if (!(k.scale_px > 0) || !(k.scale_px <= kMostScalePx))
    return " has a scale_px that is not within 0 to 8192; give pixels";
  if (!isWithin(k.orientation_rad, -kMostAngleRad, kMostAngleRad))
    return " has an angle_rad that is not within -7 to 7; give radians";
  if (!isWithin(k.response, 0, 1)) return " has a response that is not within 0 to 1; divide by the largest";
  return nullptr;
}

sphc_status checkShape(const sphc_features_arrays &arrays, uint32_t max_keypoints, sphc_message *message) {
  if (arrays.extractor != sphc::kExtractorId) {
    MessageWriter(message) << "arrays.extractor is " << arrays.extractor << ", and maps are described by "
                           << sphc::kExtractorId << "; describe with the extractor of the maps";
    return SPHC_E_MAP_EXTRACTOR;
  }
  if (arrays.count > max_keypoints) {
    MessageWriter(message) << "arrays.count is " << arrays.count << ", and config.max_keypoints is "
                           << max_keypoints << "; give the strongest, or raise it";
    return SPHC_E_CAPACITY;
  }
  const uint32_t step = arrays.keypoint_stride_bytes;
  if (step < sizeof(sphc_keypoint) || step % alignof(sphc_keypoint) || step > SPHC_STRIDE_MAX_BYTES ||
      arrays.descriptor_stride_bytes < SPHC_DESCRIPTOR_BYTES ||
      arrays.descriptor_stride_bytes > SPHC_STRIDE_MAX_BYTES) {
    MessageWriter(message) << "arrays has strides of " << step << " and " << arrays.descriptor_stride_bytes
                           << " bytes; a keypoint needs a multiple of 4, at least "
                           << static_cast<uint64_t>(sizeof(sphc_keypoint)) << ", a descriptor at least "
                           << SPHC_DESCRIPTOR_BYTES << ", both at most " << SPHC_STRIDE_MAX_BYTES;
    return SPHC_E_ARGUMENT;
  }
  if (arrays.count && (!arrays.keypoints || !arrays.descriptors)) {
    MessageWriter(message) << "arrays." << (arrays.keypoints ? "descriptors" : "keypoints")
                           << " is null, and count is " << arrays.count << "; give as many, or count 0";
    return SPHC_E_ARGUMENT;
  }
  return SPHC_OK;
}

sphc_status checkKeypoints(const sphc_features_arrays &arrays, const sphc::ImageSizes &images,
                           sphc_message *message) {
  float strongest = 1;
  for (uint32_t i = 0; i < arrays.count; ++i) {
    const Keypoint keypoint = keypointAt(arrays, i);
    const char *fault = faultOf(keypoint, cameraAt(arrays, i), images);
    if (!fault && keypoint.response > strongest)
      fault = " is stronger than the one before it; sort them, the strongest first";
    if (fault) {
      MessageWriter(message) << "keypoint " << i << fault;
      return SPHC_E_ARGUMENT;
    }
    strongest = keypoint.response;
  }
  return SPHC_OK;
}

void copyFrom(const sphc_features_arrays &arrays, FrameFeatures *features) {
  const sphc::FeatureRoom &room = features->room;
  features->count = arrays.count;
  features->seen_cameras = 0;
  for (uint32_t i = 0; i < arrays.count; ++i) {
    room.keypoints[i] = keypointAt(arrays, i);
    const uint32_t camera = cameraAt(arrays, i);
    if (camera > 0) features->seen_cameras |= sphc::seenBit(camera - 1);
    if (!room.camera_of.empty()) room.camera_of[i] = static_cast<uint8_t>(camera);
    std::memmove(room.descriptors[i].bytes, arrays.descriptors + size_t{i} * arrays.descriptor_stride_bytes,
                 SPHC_DESCRIPTOR_BYTES);
  }
  features->cut = false;
  features->took_ns = 0;
}

}  // namespace

namespace sphc {

ImageSizes imageSizesOf(const LocalizerConfig &config) {
  ImageSizes sizes;
  const auto add = [&](const sphc_camera &camera) { sizes.of[sizes.count++] = {camera.width, camera.height}; };
  add(config.color_camera.parameters());
  for (const RigCamera &further : config.further) add(further.camera.parameters());
  return sizes;
}

bool operator==(const ImageSizes &a, const ImageSizes &b) {
  const auto isSame = [](const ImageSize &x, const ImageSize &y) {
    return x.width == y.width && x.height == y.height;
  };
  return a.count == b.count && std::equal(a.of, a.of + a.count, b.of, isSame);
}

}  // namespace sphc

sphc_status sphc_features_memory(const sphc_localizer_config *config, sphc_memory *memory, sphc_message *message) {
  sphc::ConfigCopy checked;
  const sphc_status status = sphc::readConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  return sphc::giveMemory({bytesFor(sphc::localizerConfigFrom(checked.config)), 0, sphc::kArenaAlignment, 0},
                          memory, message);
}

sphc_status sphc_features_init(void *memory, size_t memory_bytes, const sphc_localizer_config *config,
                               sphc_features **features, sphc_message *message) {
  sphc::ConfigCopy checked;
  sphc_status status = sphc::readConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  if (!features) {
    MessageWriter(message) << "features is null; give a pointer to set";
    return SPHC_E_ARGUMENT;
  }
  const LocalizerConfig own = sphc::localizerConfigFrom(checked.config);
  const size_t needed = bytesFor(own);
  status = sphc::checkMemory(memory, memory_bytes, needed, sphc::kArenaAlignment, "features", message);
  if (status != SPHC_OK) return status;
  auto *made = new (memory) sphc_features();
  Arena arena(static_cast<unsigned char *>(memory) + kFeaturesBytes);
  FrameFeatures::layout(own, arena, &made->features);
  made->memory = {"features", memory, needed};
  made->color = checked.config.rig.color_camera;
  made->sizes = sphc::imageSizesOf(own);
  made->max_keypoints = checked.config.max_keypoints;
  *features = made;
  return SPHC_OK;
}

sphc_status sphc_features_set(sphc_features *features, const sphc_localizer_frame *frame,
                              const sphc_features_arrays *arrays) {
  if (!features) return SPHC_E_ARGUMENT;
  sphc_message *message = &features->message;
  message->text[0] = '\0';
  sphc_localizer_frame own_frame;
  sphc_features_arrays own = {};
  sphc_status status = sphc::readColorFrame(frame, features->color, &own_frame, message);
  if (status == SPHC_OK) status = sphc::readStruct("arrays", arrays, &own, message);
  if (status == SPHC_OK) status = checkShape(own, features->max_keypoints, message);
  if (status == SPHC_OK) status = checkKeypoints(own, features->sizes, message);
  if (status != SPHC_OK) return status;
  copyFrom(own, &features->features);
  features->features.keepGray(sphc::colorViewFrom(own_frame.color));
  features->color_time_ns = own_frame.color_time_ns;
  features->of_frame = true;
  return SPHC_OK;
}

sphc_status sphc_features_get(const sphc_features *features, sphc_features_arrays *arrays) {
  if (!features) return SPHC_E_ARGUMENT;
  uint32_t struct_size = 0;
  const sphc_status status = sphc::checkStruct("arrays", arrays, nullptr, &struct_size);
  if (status != SPHC_OK) return status;
  if (!features->of_frame) return SPHC_E_STATE;
  sphc_features_arrays own = {};
  own.extractor = sphc::kExtractorId;
  own.count = features->features.count;
  own.keypoint_stride_bytes = sizeof(sphc_keypoint);
  own.descriptor_stride_bytes = SPHC_DESCRIPTOR_BYTES;
  const sphc::FeatureRoom &room = features->features.room;
  own.keypoints = reinterpret_cast<const sphc_keypoint *>(room.keypoints.data());
  own.descriptors = room.descriptors.data()->bytes;
  own.cameras = room.camera_of.data();
  sphc::writeStruct(own, struct_size, arrays);
  return SPHC_OK;
}

const char *sphc_features_message(const sphc_features *features) {
  return features ? features->message.text : "features is null";
}

void sphc_features_fini(sphc_features **features) {
  if (features) *features = nullptr;
}
