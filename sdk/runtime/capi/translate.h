// Types of the C interface to the library's own and back.  Nothing else reads the interface's configs, frames,
// priors and results; what comes in has been validated (check.h).
#pragma once
#include "runtime/localizer/config.h"
#include "runtime/localizer/frame.h"
#include "runtime/localizer/map_set.h"
#include "runtime/localizer/motion.h"
#include "runtime/localizer/ranking.h"
#include "runtime/localizer/result.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

LocalizerConfig localizerConfigFrom(const sphc_localizer_config &config);
// Borrows the frame's images.
FrameInput frameFrom(const sphc_localizer_frame &frame, const MapSet &maps);
ColorView colorViewFrom(const sphc_image &image);
ByteView bytesOf(const sphc_image &image);
// 0 stands for DEPTH16.
DepthLayout depthLayoutFrom(sphc_format format);
sphc_localizer_outcome outcomeFrom(Outcome outcome);
sphc_localizer_state stateFrom(TrackingState state);
sphc_localizer_observation observationFrom(const Observation &observation);
sphc_localizer_hypothesis hypothesisFrom(const RankedPose &pose);
DepthSensor depthSensorFrom(const sphc_localizer_config &config);
DepthSensor depthSensorFrom(const sphc_localizer_depth_camera &camera);
// The same as the stages see it, by images that were read from this format.
DepthSensor sensorReadAs(sphc_format format, DepthSensor sensor);
DepthCalibration depthCalibrationFrom(const sphc_depth_bias &depth);
// `frame` is the one that was answered.
sphc_localizer_result resultFrom(const LocalizerResult &answer, const sphc_localizer_frame &frame);
// What is known of a pose then; the map is that with this id.
sphc_localizer_prediction predictionFrom(const MovedPose &moved, uint32_t map_id);

}  // namespace sphc
