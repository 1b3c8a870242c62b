// Do two descriptors look as if they were of the same spot?  Corners of one thing are alike in ways that strangers
// are not; a small network has learned them on other places.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/audit/attack/mlp.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

class CoOccurrence {
 public:
  // Throws std::runtime_error when the file is no such network.
  explicit CoOccurrence(const std::string &path);

  // Principal components of the descriptors, a row a descriptor.
  Eigen::MatrixXf components(const std::vector<Descriptor> &descriptors) const;
  // Of components side by side: the larger, the likelier they are neighbours.
  Eigen::ArrayXf logits(const Eigen::MatrixXf &a, const Eigen::MatrixXf &b) const { return net_(pairs(a, b)); }

 private:
  explicit CoOccurrence(const nlohmann::json &json);
  static Eigen::MatrixXf pairs(const Eigen::MatrixXf &a, const Eigen::MatrixXf &b);

  Eigen::RowVectorXf mean_;
  Eigen::MatrixXf axes_;  // a row an axis
  Mlp net_;
};

}  // namespace sphc::host
