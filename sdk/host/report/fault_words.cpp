#include "host/report/fault_words.h"

#include <spherecloud/spherecloud.h>

namespace sphc::host {

const std::array<BitWords, 13> kFaultWords = {{
    {SPHC_FAULT_DEPTH_RANGE, "depth out of range",
     "nearly every measurement lies outside depth_min_m to depth_max_m: is depth_unit_m right, is the sensor "
     "covered?"},
    {SPHC_FAULT_DEPTH_CONSTANT, "depth constant",
     "one depth everywhere: restart the depth sensor, look at its driver"},
    {SPHC_FAULT_DEPTH_BENT, "depth bent",
     "planes are not plane: the stream may be inverted, or disparity; the driver should give depth along the axis"},
    {SPHC_FAULT_DEPTH_FROZEN, "depth frozen", "the same depth image again and again: restart the depth stream"},
    {SPHC_FAULT_COLOR_FROZEN, "colour frozen", "the same colour image again and again: restart the colour stream"},
    {SPHC_FAULT_DEPTH_COLOR_DISAGREE, "depth and colour disagree",
     "edges of depth are not where the image has edges: is one of them late, mirrored, turned, cropped or scaled, "
     "is "
     "the calibration that of these cameras? `spherecloud doctor` compares them"},
    {SPHC_FAULT_DEPTH_SCALE, "depth scale",
     "poses go farther, or less far, than odometry: is depth_unit_m right, was the map made with another scale?"},
    {SPHC_FAULT_DEPTH_BIAS, "depth bias",
     "the bias that was learnt is more than a sound sensor has: calibrate the cameras again"},
    {SPHC_FAULT_VERTICAL_DISAGREES, "vertical disagrees",
     "the vertical that was given is not the pose's: check the frame and the sigma of the inertial sensor"},
    {SPHC_FAULT_MIRRORED, "mirrored",
     "left and right are changed against the map: does the camera look into a mirror, does its driver turn the "
     "image "
     "over?"},
    {SPHC_FAULT_DISTANCES_DISAGREE, "distances disagree",
     "points of the map lie elsewhere than earlier frames said: is depth what the driver says that it is (neither "
     "inverted, nor disparity, nor late), is the calibration that of these cameras, does the place look like "
     "another?"},
    {SPHC_FAULT_ODOMETRY_DISAGREES, "odometry disagrees",
     "odometry moves otherwise than poses do, so it is left out: is it the pose of the colour camera, with x "
     "right, y down and z ahead, and not its inverse; does it stand still, or know turns alone?"},
    {SPHC_FAULT_FOCAL_DISAGREES, "focal length disagrees",
     "the matches agree with another focal length of the colour camera: is the calibration that of this camera and "
     "this size of image, was the image cropped or scaled, is depth what the driver says that it is? `map "
     "--refine-calibration` calibrates anew"},
}};

std::string faultNames(uint32_t faults) { return namesOf(kFaultWords, faults); }

}  // namespace sphc::host
