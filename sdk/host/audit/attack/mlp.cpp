#include "host/audit/attack/mlp.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sphc::host {
namespace {

constexpr float kFarthest = 5;  // deviations from the mean; as in train/real_or_fake/network.py

[[noreturn]] void refuse(const std::string &what) {
  throw std::runtime_error("the model " + what + "; install the command anew, or give --networks");
}

}  // namespace

Eigen::RowVectorXf rowOf(const nlohmann::json &json, Eigen::Index size) {
  if (!json.is_array() || json.size() != static_cast<size_t>(size)) refuse("has a row of the wrong length");
  Eigen::RowVectorXf row(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const nlohmann::json &number = json[static_cast<size_t>(i)];
    if (!number.is_number()) refuse("has something else than a number in a row");
    row[i] = number.get<float>();
    if (!std::isfinite(row[i])) refuse("has a number that is not finite");
  }
  return row;
}

Eigen::MatrixXf matrixOf(const nlohmann::json &json, Eigen::Index columns) {
  if (!json.is_array() || json.empty()) refuse("lacks a matrix");
  Eigen::MatrixXf matrix(static_cast<Eigen::Index>(json.size()), columns);
  for (size_t r = 0; r < json.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = rowOf(json[r], columns);
  return matrix;
}

nlohmann::json readModel(const std::string &path, const std::string &format) {
  std::ifstream in(path);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || json.value("format", nlohmann::json()) != format)
    refuse(path + " is missing or no \"" + format + "\"");
  return json;
}

Mlp::Mlp(const nlohmann::json &json, Eigen::Index inputs) {
  if (!json.is_object() || !json.contains("mean") || !json.contains("scale") || !json.contains("layers"))
    refuse("lacks a network");
  mean_ = rowOf(json["mean"], inputs);
  scale_ = rowOf(json["scale"], inputs);
  if (!json["layers"].is_array()) refuse("lacks layers");
  for (const nlohmann::json &layer : json["layers"]) {
    if (!layer.is_object() || !layer.contains("weights") || !layer.contains("bias")) refuse("lacks a layer");
    Layer next = {matrixOf(layer["weights"], inputs), {}};
    inputs = next.weights.rows();
    next.bias = rowOf(layer["bias"], inputs);
    layers_.push_back(std::move(next));
  }
  if (layers_.empty() || inputs != 1) refuse("does not end in one number");
}

Eigen::ArrayXf Mlp::operator()(const Eigen::MatrixXf &rows) const {
  Eigen::MatrixXf x = (rows.rowwise() - mean_).array().rowwise() * scale_.array();
  x = x.cwiseMax(-kFarthest).cwiseMin(kFarthest);
  for (size_t i = 0; i < layers_.size(); ++i) {
    x = (x * layers_[i].weights.transpose()).rowwise() + layers_[i].bias;
    if (i + 1 < layers_.size()) x = x.cwiseMax(0.0f);
  }
  return x.col(0).array();
}

}  // namespace sphc::host
