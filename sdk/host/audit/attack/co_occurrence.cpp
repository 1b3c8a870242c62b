#include "host/audit/attack/co_occurrence.h"

#include <nlohmann/json.hpp>

namespace sphc::host {

CoOccurrence::CoOccurrence(const std::string &path)
    : CoOccurrence(readModel(path, "spherecloud co-occurrence 1")) {}

CoOccurrence::CoOccurrence(const nlohmann::json &json)
    : mean_(rowOf(json.value("mean", nlohmann::json()), kDescriptorBytes)),
      axes_(matrixOf(json.value("axes", nlohmann::json()), kDescriptorBytes)),
      net_(json.value("network", nlohmann::json()), 3 * axes_.rows()) {}

Eigen::MatrixXf CoOccurrence::components(const std::vector<Descriptor> &descriptors) const {
  Eigen::MatrixXf bytes(static_cast<Eigen::Index>(descriptors.size()), static_cast<Eigen::Index>(kDescriptorBytes));
  for (size_t i = 0; i < descriptors.size(); ++i)
    bytes.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Matrix<uint8_t, 1, kDescriptorBytes>>(descriptors[i].bytes).cast<float>();
  return (bytes.rowwise() - mean_) * axes_.transpose();
}

// The same whichever comes first.
Eigen::MatrixXf CoOccurrence::pairs(const Eigen::MatrixXf &a, const Eigen::MatrixXf &b) {
  Eigen::MatrixXf pairs(a.rows(), 3 * a.cols());
  pairs << (a - b).cwiseAbs(), a.cwiseProduct(b) / 100, a + b;
  return pairs;
}

}  // namespace sphc::host
