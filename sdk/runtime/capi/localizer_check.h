// Checks of what a localizer is given beside its frames.
#pragma once
#include "runtime/capi/frame_copy.h"
#include "runtime/capi/objects.h"
#include "runtime/types/depth_calibration.h"

namespace sphc {

sphc_status checkPlacement(const sphc_rigid &common_from_map, double rotation_sigma_rad, double translation_sigma_m,
                           sphc_message *message);
// Can a localizer of this prior go on from what was learnt of its depth sensor?
sphc_status checkDepthBias(const sphc_depth_bias *depth, const DepthCalibration &prior, sphc_message *message);
// Were features made for a localizer of this image size and room?
sphc_status checkFeatures(const sphc_features &features, const sphc_localizer &localizer, sphc_message *message);
// And of this frame?
sphc_status checkFeaturesOf(const sphc_localizer_frame &frame, const sphc_features *features,
                            const sphc_localizer &localizer, sphc_message *message);
// Are the images that a half of a frame reads apart from what the localizer writes to meanwhile?
sphc_status checkColorImagesApart(const sphc_localizer_frame &frame, const sphc_localizer &localizer,
                                  sphc_message *message);
sphc_status checkDepthImagesApart(const sphc_localizer_frame &frame, const sphc_localizer &localizer,
                                  sphc_message *message);
// Is it apart from a map's view and file?
sphc_status checkApartFromMap(const MemoryRange &written, const sphc_map &map, sphc_message *message);

}  // namespace sphc
