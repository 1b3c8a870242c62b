// Frames through the localizer, and what it tells of them.
#include <algorithm>
#include <cstddef>
#include <cstring>

#include "runtime/capi/check.h"
#include "runtime/capi/defaults.h"
#include "runtime/capi/frame_copy.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/localizer_check.h"
#include "runtime/capi/log.h"
#include "runtime/capi/objects.h"
#include "runtime/capi/translate.h"

namespace {

using sphc::Localizer;
using sphc::LocalizerResult;

sphc::FrameLimits limitsOf(const sphc_localizer &localizer, bool looks_at_images) {
  return {looks_at_images, localizer.localizer.config(), localizer.depth_formats, localizer.localizer.maps(),
          localizer.has_clock};
}

sphc_status giveOut(const LocalizerResult &answer, const sphc_localizer_frame &frame, uint32_t struct_size,
                    sphc_localizer *localizer, sphc_localizer_result *result) {
  const sphc_localizer_result own = sphc::resultFrom(answer, frame);
  sphc::writeStruct(own, struct_size, result);
  sphc::logFrame(frame, own, localizer);
  return own.outcome == SPHC_OUTCOME_LOCALIZED ? SPHC_OK : SPHC_NOT_LOCALIZED;
}

// Elements at a stride of the caller's, by which the library knows which fields the caller has; `first_bytes`: when
// they were first published.
template <typename Own, typename Element>
sphc_status giveOutAll(sphc::Span<const Own> all, Element (*elementFrom)(const Own &), Element *to,
                       size_t first_bytes, uint32_t stride_bytes, uint32_t capacity, uint32_t *count) {
  if (!count || (capacity && !to)) return SPHC_E_ARGUMENT;
  if (stride_bytes < first_bytes || stride_bytes % alignof(Element)) return SPHC_E_ARGUMENT;
  auto *bytes = reinterpret_cast<unsigned char *>(to);
  const size_t shared = std::min(size_t{stride_bytes}, sizeof(Element));
  for (uint32_t i = 0; i < capacity && i < all.size(); ++i, bytes += stride_bytes) {
    const Element own = elementFrom(all[i]);
    std::memcpy(bytes, &own, shared);
    std::memset(bytes + shared, 0, stride_bytes - shared);
  }
  *count = static_cast<uint32_t>(all.size());
  return SPHC_OK;
}

}  // namespace

sphc_status sphc_localizer_process(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                                   sphc_localizer_result *result) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  sphc::FrameCopy copy;
  uint32_t struct_size = 0;
  sphc_status status = sphc::readFrame(frame, limitsOf(*localizer, true), &copy, message);
  if (status == SPHC_OK) status = sphc::checkDepthImagesApart(copy.frame, *localizer, message);
  if (status == SPHC_OK) status = sphc::checkColorImagesApart(copy.frame, *localizer, message);
  if (status == SPHC_OK) status = sphc::checkStruct("result", result, message, &struct_size);
  if (status != SPHC_OK) return status;
  Localizer &own_localizer = localizer->localizer;
  const LocalizerResult answer = own_localizer.process(sphc::frameFrom(copy.frame, own_localizer.maps()));
  return giveOut(answer, copy.frame, struct_size, localizer, result);
}

sphc_status sphc_localizer_extract(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                                   sphc_features *features) {
  if (!localizer || !features) return SPHC_E_ARGUMENT;
  sphc_message *message = &features->message;  // the localizer's is of the thread that locates
  message->text[0] = '\0';
  sphc::FrameCopy copy;
  sphc_status status = sphc::readFeatureFrame(frame, limitsOf(*localizer, true), &copy, message);
  if (status == SPHC_OK) status = sphc::checkColorImagesApart(copy.frame, *localizer, message);
  if (status == SPHC_OK) status = sphc::checkFeatures(*features, *localizer, message);
  if (status != SPHC_OK) return status;
  // Not looked at, and not validated.
  copy.frame.prior = nullptr;
  copy.frame.depth_camera = nullptr;
  copy.frame.depth_view_count = 0;
  localizer->localizer.extract(sphc::frameFrom(copy.frame, localizer->localizer.maps()), &features->features);
  features->color_time_ns = copy.frame.color_time_ns;
  features->of_frame = true;
  return SPHC_OK;
}

sphc_status sphc_localizer_locate(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                                  const sphc_features *features, sphc_localizer_result *result) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  sphc::FrameCopy copy;
  uint32_t struct_size = 0;
  sphc_status status = sphc::readFrame(frame, limitsOf(*localizer, false), &copy, message);
  if (status == SPHC_OK) status = sphc::checkDepthImagesApart(copy.frame, *localizer, message);
  if (status == SPHC_OK) status = sphc::checkFeaturesOf(copy.frame, features, *localizer, message);
  if (status == SPHC_OK) status = sphc::checkStruct("result", result, message, &struct_size);
  if (status != SPHC_OK) return status;
  Localizer &own_localizer = localizer->localizer;
  const sphc::FrameInput input = sphc::frameFrom(copy.frame, own_localizer.maps());
  return giveOut(own_localizer.locate(input, features->features), copy.frame, struct_size, localizer, result);
}

double sphc_localizer_result_confidence(const sphc_localizer_result *result, double translation_m,
                                        double rotation_rad) {
  if (!result || result->outcome != SPHC_OUTCOME_LOCALIZED) return 0;
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(result->covariance);
  if (!(covariance.trace() > 0)) return 0;  // of no pose, which is never known to the last digit
  return sphc::Localizer::confidenceWithin(covariance, translation_m, rotation_rad);
}

sphc_status sphc_localizer_predict(const sphc_localizer *localizer, int64_t time_ns,
                                   sphc_localizer_prediction *prediction) {
  if (!localizer) return SPHC_E_ARGUMENT;
  uint32_t struct_size = 0;
  const sphc_status status = sphc::checkStruct("prediction", prediction, nullptr, &struct_size);
  if (status != SPHC_OK) return status;
  const Localizer &own_localizer = localizer->localizer;
  sphc::MovedPose moved;
  const bool is_known = own_localizer.predict(time_ns, &moved);
  sphc_localizer_prediction own =
      is_known ? sphc::predictionFrom(moved, own_localizer.maps().idOf(moved.map)) : sphc::emptyPrediction();
  own.time_ns = time_ns;
  own.state = sphc::stateFrom(own_localizer.state());
  sphc::writeStruct(own, struct_size, prediction);
  return is_known ? SPHC_OK : SPHC_NOT_LOCALIZED;
}

sphc_status sphc_localizer_observations(const sphc_localizer *localizer, sphc_localizer_observation *observations,
                                        uint32_t stride_bytes, uint32_t capacity, uint32_t *count) {
  if (!localizer) return SPHC_E_ARGUMENT;
  return giveOutAll(localizer->localizer.observations(), sphc::observationFrom, observations,
                    offsetof(sphc_localizer_observation, camera), stride_bytes, capacity, count);
}

sphc_status sphc_localizer_hypotheses(const sphc_localizer *localizer, sphc_localizer_hypothesis *hypotheses,
                                      uint32_t stride_bytes, uint32_t capacity, uint32_t *count) {
  if (!localizer) return SPHC_E_ARGUMENT;
  return giveOutAll(localizer->localizer.hypotheses(), sphc::hypothesisFrom, hypotheses,
                    sizeof(sphc_localizer_hypothesis), stride_bytes, capacity, count);
}
