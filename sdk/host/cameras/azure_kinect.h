// Azure Kinect's raw calibration.  Lengths are in units of the sensor's width and height from its corner; of the
// distortion OpenCV's rational model; Rt is camera_from_rig in metres, the rig being the depth camera.
#pragma once
#include <string>

#include "host/cameras/part.h"

namespace sphc::host {

// A camera of the model Rational6KT with a tangential part is inexact: its numbers are taken as OpenCV's.  Throws
// std::runtime_error, "file: key: cause; cure".
CalibrationPart readAzureKinect(const TextFile &file);
// accelerometer_from_rig; nothing where the file has none.  Throws likewise.
std::optional<sphc_rigid> readAzureKinectAccelerometer(const TextFile &file);
std::string azureKinectText(const sphc_rig &calibration);

}  // namespace sphc::host
