// A small network, read from JSON: standardised inputs, layers with rectifiers between them, one number out.
#pragma once
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace sphc::host {

class Mlp {
 public:
  // `json`: mean, scale, layers of weights (a row an output) and bias.  Throws std::runtime_error when it is
  // anything else than a network with `inputs` inputs.
  Mlp(const nlohmann::json &json, Eigen::Index inputs);

  // A number a row.
  Eigen::ArrayXf operator()(const Eigen::MatrixXf &rows) const;

 private:
  struct Layer {
    Eigen::MatrixXf weights;
    Eigen::RowVectorXf bias;
  };

  Eigen::RowVectorXf mean_, scale_;
  std::vector<Layer> layers_;
};

// Throws std::runtime_error when there is no JSON of that `format`.
nlohmann::json readModel(const std::string &path, const std::string &format);
Eigen::RowVectorXf rowOf(const nlohmann::json &json, Eigen::Index size);
Eigen::MatrixXf matrixOf(const nlohmann::json &json, Eigen::Index columns);

}  // namespace sphc::host
