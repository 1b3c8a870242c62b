// The formats: a reader of text and a writer of text each.  docs/calibration.md has what each can hold.
// Readers throw std::runtime_error, "file: key: cause; cure".  Writers take a checked calibration whose cameras the
// format holds exactly (formatHolds); `name` is that of the file, or folder, that will be written.
#pragma once
#include <string>
#include <vector>

#include "host/cameras/part.h"

namespace sphc::host {

enum class Format { kSpherecloud, kOpencv, kKalibr, kRos, kColmap, kAzureKinect };

struct FormatName {
  Format format;
  const char *name;
  bool is_folder;  // several files
  bool has_depth_unit;
};
const std::vector<FormatName> &formatNames();
const FormatName &nameOf(Format format);

// By the text, and for COLMAP by the name.  Throws when nothing fits.
Format detectFormat(const TextFile &file);

bool formatHolds(Format format, const sphc_camera &camera);

// `rigs`: COLMAP's rigs.txt; null if there is none, and for all others.
CalibrationPart readCalibration(Format format, const TextFile &file, const TextFile *rigs);
std::vector<TextFile> writeCalibration(Format format, const sphc_rig &calibration);

CalibrationPart readOpencv(const TextFile &file);
CalibrationPart readKalibr(const TextFile &file);
CalibrationPart readRos(const TextFile &file);
CalibrationPart readColmap(const TextFile &cameras, const TextFile *rigs);

// Those of ROS in a folder, in the order in which they are read.
constexpr const char *kRosNames[] = {"color.yaml", "depth.yaml", "extrinsics.yaml"};

// One text; ROS and COLMAP files by their names in the folder.
std::string opencvText(const sphc_rig &calibration);
// Keys R and T alone.
std::string opencvExtrinsics(const sphc_rigid &depth_from_color);
std::string kalibrText(const sphc_rig &calibration);
std::vector<TextFile> rosTexts(const sphc_rig &calibration);
std::vector<TextFile> colmapTexts(const sphc_rig &calibration);

}  // namespace sphc::host
