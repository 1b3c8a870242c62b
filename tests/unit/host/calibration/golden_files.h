// Calibration files as the formats' own documentation writes them.
#pragma once

namespace sphc::host {

extern const char *const kKalibrFile,
    *const kRosColorFile, *const kRosDepthFile, *const kOpencvSampleFile, *const kOpencvStereoFile,
                                                                              *const kColmapCamerasFile,
                                                                                  *const kColmapRigsFile,
                                                                                      *const kAzureKinectFile;

}  // namespace sphc::host
