// The calibration file and its text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibration.h"

namespace sphc::recording {

// The rig, where it can be used; else throws Failure with sphc_rig_check's message.
const sphc_rig &requireGood(const sphc_rig &rig);

// Does depth lie on the colour image?  Then the file has one camera, which is where the other is.
bool isRegistered(const sphc_rig &rig);

// Throw Failure with the file's name.  What is written reads back to the bit.
sphc_rig readCalibration(const std::filesystem::path &path);
void writeCalibration(const std::filesystem::path &path, const sphc_rig &rig);

// Throws Failure; its text begins with the key.
sphc_rig calibrationFromJson(std::string_view text);
std::string calibrationToJson(const sphc_rig &rig);

}  // namespace sphc::recording
