// A thing that somebody has a picture of.
#pragma once
#include <vector>

#include "host/import/point_model.h"

namespace sphc::host {

constexpr size_t kObjectPoints = 40;

// Descriptors of the points of the frame that lie nearest to one of them, itself among them: kObjectPoints at most.
std::vector<Descriptor> objectIn(std::vector<ModelPoint> frame, uint32_t around);

}  // namespace sphc::host
