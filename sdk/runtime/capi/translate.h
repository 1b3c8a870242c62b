// Types of the C interface to the library's own and back.  Nothing else reads the interface's configs, frames,
// priors and results; what comes in has been validated (check.h).
#pragma once
#include "runtime/localizer/config.h"
#include "runtime/localizer/frame.h"
#include "runtime/localizer/result.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

LocalizerConfig localizerConfigFrom(const sphc_config &config);
// Borrows the frame's images.
FrameInput frameFrom(const sphc_frame &frame);
ImageView<uint16_t> depthViewFrom(const sphc_image &image);
sphc_outcome outcomeFrom(Outcome outcome);
sphc_state stateFrom(TrackingState state);
sphc_observation observationFrom(const Observation &observation);
// `frame` is the one that was answered.
sphc_result resultFrom(const LocalizerResult &answer, const sphc_frame &frame);

}  // namespace sphc
