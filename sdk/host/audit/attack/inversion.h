// Image inversion: published points, seen through a virtual camera, painted by a network that was trained on
// pictures of other places (docs/inversion.md).
#pragma once
#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "runtime/geometry/rigid.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

struct SeenPoints {
  std::vector<Vector2> pixels_px;  // of VirtualCamera
  std::vector<Descriptor> descriptors;
  std::vector<float> weights;  // how much an attacker believes in each; 0 prunes it
};

// `points` are positions in metres or, with no translation, directions.  No weights: all points count alike.
SeenPoints see(const std::vector<Vector3> &points, const std::vector<Descriptor> &descriptors,
               const std::vector<float> &weights, const Rigid &camera_from_map);

class Inverter {
 public:
  // The network FOLDER/NAME.embedding.onnx and .painter.onnx.  Throws std::runtime_error when it cannot be read.
  Inverter(const std::string &folder, const std::string &name);

  // A grey picture, VirtualCamera's side, CV_32F, of about mean 0 and deviation 1.  No points: a grey of 0.
  cv::Mat paint(const SeenPoints &seen);

 private:
  cv::Mat planes(const SeenPoints &seen);

  cv::dnn::Net embedding_, painter_;
};

}  // namespace sphc::host
