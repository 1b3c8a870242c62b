// The truth for inversion at the centre: a mapping recording's colours and depths, seen from the map's centre.
#pragma once
#include <functional>
#include <vector>

#include "host/audit/score/panorama.h"
#include "host/recording/recording_reader.h"

namespace sphc::host {

// Told before each frame how many are done.
using FramesRead = std::function<void(uint32_t done, uint32_t total)>;

// All frames with a pose.  Throws std::runtime_error, with cause and cure, where there are none.
Panorama panoramaFrom(recording::RecordingReader *reader, const Vector3 &centre_m, const FramesRead &progress);

// Rotations to look in, camera_from_map: upright like the recording's frames, axes at least `apart_deg` from each
// other, and enough of the view known.
std::vector<Matrix3> choosePoses(recording::RecordingReader *reader, const Panorama &panorama, double apart_deg,
                                 double seen_share);

// Both: the views that are inverted.
std::vector<InversionView> viewsFromCentre(recording::RecordingReader *reader, const Vector3 &centre_m,
                                           const FramesRead &progress);

}  // namespace sphc::host
