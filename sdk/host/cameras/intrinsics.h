// Intrinsics by name, to and from the C interface's camera models.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

// Where a format puts the centre of the top-left pixel; added to its principal points it gives ours.
constexpr double kZeroCentered = 0.5;    // OpenCV, Kalibr, ROS: (0, 0)
constexpr double kCornerCentered = 0.0;  // COLMAP, Azure Kinect: (0.5, 0.5)

// Focal lengths and principal point of an image of width x height, our pixel centres.
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  uint32_t width = 0, height = 0;
};

// OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6.  The simplest model that holds them exactly.
sphc_camera brownCamera(const Intrinsics &intrinsics, const std::array<double, 8> &distortion);
// k1 k2 k3 k4 of the Kannala-Brandt model, which OpenCV calls fisheye and ROS equidistant.
sphc_camera fisheyeCamera(const Intrinsics &intrinsics, const std::array<double, 4> &distortion);

// A list of OpenCV's: 0, 4, 5, 8, or 12 to 14 whose last ones are 0.  Empty and `camera` set, or what is wrong.
std::string cameraFromOpencv(const Intrinsics &intrinsics, std::vector<double> distortion, bool fisheye,
                             sphc_camera *camera);
// distortion_model and D of a camera_info of ROS.  Empty and `camera` set, or the model and what is read instead.
std::string cameraFromRos(const Intrinsics &intrinsics, const std::string &model,
                          const std::vector<double> &distortion, sphc_camera *camera);
// Of cameraFromOpencv: 5 or 8 coefficients, or 4 of a fisheye.
std::vector<double> opencvDistortion(const sphc_camera &camera);

// Row-major 3 x 3 with fx, fy, cx, cy and nothing else; cx and cy get `shift` added.  Empty, or what is wrong.
std::string intrinsicsFromMatrix(const std::vector<double> &rows, double shift, Intrinsics *intrinsics);
std::vector<double> matrixFromCamera(const sphc_camera &camera, double shift);

bool isFisheye(const sphc_camera &camera);
// No fisheye, and nothing behind k1 k2 p1 p2.
bool hasFourCoefficients(const sphc_camera &camera);

}  // namespace sphc::host
