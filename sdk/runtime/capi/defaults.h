// What the C interface has where the caller says nothing.
#pragma once
#include "spherecloud/spherecloud.h"

namespace sphc {

sphc_localizer_config defaultConfig();
sphc_aligner_config defaultAlignerConfig();
sphc_localizer_camera emptyCamera();
sphc_localizer_depth_camera emptyDepthCamera();
sphc_localizer_prior emptyPrior();
// Of no map.
sphc_localizer_result emptyResult();
sphc_localizer_prediction emptyPrediction();

}  // namespace sphc
