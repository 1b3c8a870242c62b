#include "runtime/capi/localizer_check.h"

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/transform.h"

namespace sphc {
namespace {

// Is it apart from all that the localizer writes to?
sphc_status checkApartFrom(const sphc_localizer &localizer, const MemoryRange &other, sphc_message *message) {
  const sphc_status status = checkApart(localizer.state, other, message);
  return status == SPHC_OK ? checkApart(localizer.scratch, other, message) : status;
}

// Of what is read: behind the last row there may be no padding, and so the localizer's memory.
sphc_status checkImageApart(const sphc_localizer &localizer, const char *name, const sphc_image &image,
                            sphc_message *message) {
  if (!image.data) return SPHC_OK;
  const size_t bytes =
      size_t{image.stride_bytes} * (image.height - 1) + sphc_format_row_bytes(image.format, image.width);
  return checkApartFrom(localizer, {name, image.data, bytes}, message);
}

// Of the i-th depth camera.  An amplitude image that is not looked at may be anything.
sphc_status checkDepthImageApart(const sphc_localizer &localizer, uint32_t i, const sphc_image &depth,
                                 const sphc_image &amplitude, sphc_message *message) {
  const char *name = i == 0 ? "the depth image" : "the depth image of a view";
  const sphc_status status = checkImageApart(localizer, name, depth, message);
  const bool is_read = depth.data && localizer.localizer.config().depth[i].least_amplitude > 0;
  return status == SPHC_OK && is_read ? checkImageApart(localizer, "the amplitude image", amplitude, message)
                                      : status;
}

}  // namespace

sphc_status checkPlacement(const sphc_rigid &common_from_map, double rotation_sigma_rad, double translation_sigma_m,
                           sphc_message *message) {
  const bool fine = checkTransform("common_from_map", common_from_map, SPHC_POSE_MAX_OFFSET_M, message) &&
                    inRange("", "rotation_sigma_rad", rotation_sigma_rad, 0, 0.5, message) &&
                    inRange("", "translation_sigma_m", translation_sigma_m, 0, 100, message);
  return fine ? SPHC_OK : SPHC_E_ARGUMENT;
}

sphc_status checkDepthBias(const sphc_depth_bias *depth, const DepthCalibration &prior, sphc_message *message) {
  if (!depth) {
    MessageWriter(message) << "depth is null; give result.depth of an earlier frame";
    return SPHC_E_ARGUMENT;
  }
  const sphc_depth_bias &d = *depth;
  constexpr double kRounding = 1 + 1e-4, kMostOffsetM = 1, kMostSlope = 0.5;
  const double offset_sigma_m = sqrtOf(prior.covariance(0, 0)) * kRounding,
               slope_sigma = sqrtOf(prior.covariance(1, 1)) * kRounding;
  const auto lies = [&](const char *name, double value, double low, double high) {
    return inRange("depth.", name, value, low, high, message);
  };
  const double most_m = prior.isKnown() ? 0 : kMostOffsetM, most_slope = prior.isKnown() ? 0 : kMostSlope;
  const double least = prior.isKnown() ? 0 : kLeastSigma;
  if (!(d.mid_m >= prior.mid_m / kRounding && d.mid_m <= prior.mid_m * kRounding)) {
    MessageWriter(message) << "depth.mid_m is " << d.mid_m << ", and the localizer's " << prior.mid_m
                           << ": it was learnt with another config.depth_mid_m, or range; begin without it";
    return SPHC_E_ARGUMENT;
  }
  const bool fine = lies("offset_m", d.offset_m, -most_m, most_m) &&
                    lies("slope", d.slope, -most_slope, most_slope) &&
                    lies("offset_sigma_m", d.offset_sigma_m, least, offset_sigma_m) &&
                    lies("slope_sigma", d.slope_sigma, least, slope_sigma) &&
                    lies("correlation", d.correlation, -0.9999, 0.9999) &&
                    lies("noise_scale", d.noise_scale, kLeastNoiseScale, kMostNoiseScale);
  return fine ? SPHC_OK : SPHC_E_ARGUMENT;
}

sphc_status checkFeatures(const sphc_features &features, const sphc_localizer &localizer, sphc_message *message) {
  const ImageSize &of = features.sizes.of[0];
  const sphc_camera &own = localizer.localizer.config().color_camera.parameters();
  const bool same = features.max_keypoints == localizer.max_keypoints &&
                    features.sizes == imageSizesOf(localizer.localizer.config());
  if (!same) {
    MessageWriter(message) << "the features are made for " << features.max_keypoints << " keypoints of "
                           << features.sizes.count << " cameras, the first of " << of.width << " x " << of.height
                           << " pixels, the localizer for " << localizer.max_keypoints << " of "
                           << 1 + localizer.localizer.config().further.size() << ", the first of " << own.width
                           << " x " << own.height << "; make both with one config";
    return SPHC_E_ARGUMENT;
  }
  return checkApartFrom(localizer, features.memory, message);
}

sphc_status checkFeaturesOf(const sphc_localizer_frame &frame, const sphc_features *features,
                            const sphc_localizer &localizer, sphc_message *message) {
  if (!features) {
    MessageWriter(message) << "features is null; make some with sphc_features_init";
    return SPHC_E_ARGUMENT;
  }
  if (!features->of_frame) {
    MessageWriter(message) << "the features are of no frame yet; call sphc_localizer_extract or sphc_features_set";
    return SPHC_E_STATE;
  }
  if (features->color_time_ns != frame.color_time_ns) {
    MessageWriter(message) << "the features are of the image at " << features->color_time_ns
                           << " ns, and frame.color_time_ns is " << frame.color_time_ns
                           << "; give each frame the features of its own image";
    return SPHC_E_ARGUMENT;
  }
  return checkFeatures(*features, localizer, message);
}

sphc_status checkColorImagesApart(const sphc_localizer_frame &frame, const sphc_localizer &localizer,
                                  sphc_message *message) {
  sphc_status status = checkImageApart(localizer, "the color image", frame.color, message);
  for (uint32_t i = 0; i < frame.view_count && status == SPHC_OK; ++i)
    status = checkImageApart(localizer, "the image of a view", frame.views[i].image, message);
  return status;
}

sphc_status checkDepthImagesApart(const sphc_localizer_frame &frame, const sphc_localizer &localizer,
                                  sphc_message *message) {
  sphc_status status = checkDepthImageApart(localizer, 0, frame.depth, frame.amplitude, message);
  for (uint32_t i = 0; i < frame.depth_view_count && status == SPHC_OK; ++i) {
    const sphc_localizer_depth_view &view = frame.depth_views[i];
    status = checkDepthImageApart(localizer, i + 1, view.depth, view.amplitude, message);
  }
  return status;
}

sphc_status checkApartFromMap(const MemoryRange &written, const sphc_map &map, sphc_message *message) {
  const MapHeader &file = map.view.header();
  const sphc_status status = checkApart(written, {"the view of a map", &map, sizeof map}, message);
  if (status != SPHC_OK) return status;
  return checkApart(written, {"the file of a map", &file, static_cast<size_t>(file.file_bytes)}, message);
}

}  // namespace sphc
