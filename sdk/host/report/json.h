// Machine-readable results: a line a frame, and the summary.
#pragma once
#include <nlohmann/json.hpp>

#include "host/report/statistics.h"

namespace sphc::host {

// Bytes of a name that are no UTF-8 are replaced.
std::string jsonText(const nlohmann::ordered_json &value, int indent = -1);

// `base`: "world" or "map"; the pose stands under "<base>_from_camera".
nlohmann::ordered_json frameJson(const FrameRecord &frame, const std::string &base);
// Frames as JSON lines.
std::string framesJsonLines(const Run &run);

nlohmann::ordered_json summaryJson(const Run &run, const Summary &summary);

}  // namespace sphc::host
