// The inertial track of an Azure Kinect's recording.
#pragma once

#include "host/recording/foreign/matroska.h"
#include "host/recording/mcap/messages.h"

namespace sphc::recording {

// In the sensor's axes; times increase, by the clock of the images.  `*bad_count` are samples that are none.
std::vector<TimedAcceleration> kinectAccelerations(const std::filesystem::path &file, const MatroskaTrack &track,
                                                   int64_t start_ns, uint32_t *bad_count);

}  // namespace sphc::recording
