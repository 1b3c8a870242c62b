#include "host/audit/attack/stack_classifier.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/audit/attack/mlp.h"
#include "host/audit/attack/stack_features.h"

namespace sphc::host {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;

// As in train/real_or_fake/stack_network.py.
constexpr float kFarthestTold = 5;  // deviations of a feature from its mean
constexpr float kMiddle = 40;       // of descriptors' bytes
constexpr float kUnit = 0.07f;      // of distances in a stack: radians, half a patch
constexpr float kReaches[] = {0.05f, 0.15f, 0.4f, 1};
constexpr Index kClosenesses = 2 + std::size(kReaches), kHeads = 4;
constexpr size_t kMostPoints = 128;  // at once; a larger stack is taken in parts

[[noreturn]] void refuseStacks(const std::string &what) {
  throw std::runtime_error("the model of stacks " + what + "; install the command anew, or give --networks");
}

const nlohmann::json &partOf(const nlohmann::json &json, const char *name) {
  if (!json.is_object() || !json.contains(name)) refuseStacks(std::string("lacks ") + name);
  return json[name];
}

// How near the points are to each other, in several ways: a row a pair, points' order.
MatrixXf closenessOf(const Published &map, const std::vector<size_t> &points) {
  const auto count = static_cast<Index>(points.size());
  MatrixXf closeness(count * count, kClosenesses);
  for (Index a = 0; a < count; ++a)
    for (Index b = 0; b < count; ++b) {
      const Vector3 apart =
          map.directions[points[static_cast<size_t>(a)]] - map.directions[points[static_cast<size_t>(b)]];
      const float distance = static_cast<float>(apart.norm()) / kUnit;
      auto row = closeness.row(a * count + b);
      row[0] = std::log(distance + 0.02f);
      row[1] = distance;
      for (Index k = 0; k < static_cast<Index>(std::size(kReaches)); ++k)
        row[2 + k] = std::exp(-(distance / kReaches[k]) * (distance / kReaches[k]));
    }
  return closeness;
}

MatrixXf rectified(const MatrixXf &x) { return x.cwiseMax(0.0f); }

}  // namespace

StackClassifier::Linear::Linear(const nlohmann::json &json, Index inputs)
    : weights(matrixOf(partOf(json, "weights"), inputs)), bias(rowOf(partOf(json, "bias"), weights.rows())) {
  weights = rowOf(partOf(json, "scale"), weights.rows()).asDiagonal() * weights;
}

MatrixXf StackClassifier::Linear::operator()(const MatrixXf &rows) const {
  return (rows * weights.transpose()).rowwise() + bias;
}

StackClassifier::Norm::Norm(const nlohmann::json &json, Index size)
    : gain(rowOf(partOf(json, "gain"), size)), bias(rowOf(partOf(json, "bias"), size)) {}

MatrixXf StackClassifier::Norm::operator()(const MatrixXf &rows) const {
  const MatrixXf centred = rows.colwise() - rows.rowwise().mean();
  const Eigen::VectorXf deviation =
      (centred.rowwise().squaredNorm() / static_cast<float>(rows.cols())).array() + 1e-5f;
  return ((deviation.cwiseSqrt().cwiseInverse().asDiagonal() * centred) * gain.asDiagonal()).rowwise() + bias;
}

StackClassifier::Block::Block(const nlohmann::json &json, Index width)
    : before_attention(partOf(json, "before_attention"), width),
      before_change(partOf(json, "before_change"), width),
      queries_keys_values(partOf(json, "queries_keys_values"), width),
      of_distance(partOf(json, "of_distance"), kClosenesses),
      mix(partOf(json, "mix"), width),
      widen(partOf(json, "widen"), width),
      narrow(partOf(json, "narrow"), widen.weights.rows()) {
  if (queries_keys_values.weights.rows() != 3 * width || of_distance.weights.rows() != kHeads ||
      mix.weights.rows() != width || narrow.weights.rows() != width)
    refuseStacks("has a block of the wrong size");
}

StackClassifier::StackClassifier(const std::string &path)
    : StackClassifier(readModel(path, "spherecloud stacks 1")) {}

StackClassifier::StackClassifier(const nlohmann::json &json)
    : mean_(rowOf(partOf(json, "mean"), kStackFeatures)),
      scale_(rowOf(partOf(json, "scale"), kStackFeatures)),
      looks_first_(partOf(json, "looks_first"), kDescriptorBytes),
      looks_second_(partOf(json, "looks_second"), looks_first_.weights.rows()),
      told_(partOf(json, "told"), kStackFeatures),
      last_(partOf(json, "last"), told_.weights.rows()),
      logit_(partOf(json, "logit"), told_.weights.rows()) {
  const Index width = told_.weights.rows();
  if (looks_second_.weights.rows() != width || width % kHeads != 0 || logit_.weights.rows() != 1)
    refuseStacks("has layers of the wrong size");
  if (!partOf(json, "blocks").is_array()) refuseStacks("lacks blocks");
  for (const nlohmann::json &block : json["blocks"]) blocks_.emplace_back(block, width);
}

MatrixXf StackClassifier::attend(const Block &block, const MatrixXf &x, const MatrixXf &closeness) {
  const Index count = x.rows(), width = x.cols(), part = width / kHeads;
  const MatrixXf all = block.queries_keys_values(block.before_attention(x)), near = block.of_distance(closeness);
  MatrixXf heard(count, width);
  for (Index head = 0; head < kHeads; ++head) {
    const auto queries = all.middleCols(head * part, part), keys = all.middleCols(width + head * part, part),
               values = all.middleCols(2 * width + head * part, part);
    // Of a row a point: pairs lie point by point, so a matrix of them has its columns where points are rows.
    const Eigen::Map<const MatrixXf> nearness(near.col(head).data(), count, count);
    MatrixXf weights = queries * keys.transpose() / std::sqrt(static_cast<float>(part)) + nearness.transpose();
    weights = (weights.colwise() - weights.rowwise().maxCoeff()).array().exp();
    heard.middleCols(head * part, part) = weights.rowwise().sum().cwiseInverse().asDiagonal() * (weights * values);
  }
  return block.mix(heard);
}

Eigen::VectorXf StackClassifier::ofStack(const Published &map, const MatrixXf &features,
                                         const std::vector<size_t> &points) const {
  const auto count = static_cast<Index>(points.size());
  MatrixXf looks(count, static_cast<Index>(kDescriptorBytes)), told(count, kStackFeatures);
  for (Index i = 0; i < count; ++i) {
    const size_t point = points[static_cast<size_t>(i)];
    looks.row(i) =
        Eigen::Map<const Eigen::Matrix<uint8_t, 1, kDescriptorBytes>>(map.descriptors[point].bytes).cast<float>();
    told.row(i) = (features.row(static_cast<Index>(point)) - mean_).cwiseProduct(scale_);
  }
  looks = (looks.array() - kMiddle) / kMiddle;
  told = told.cwiseMax(-kFarthestTold).cwiseMin(kFarthestTold);
  MatrixXf x = looks_second_(rectified(looks_first_(looks))) + told_(told);
  const MatrixXf closeness = closenessOf(map, points);
  for (const Block &block : blocks_) {
    x += attend(block, x, closeness);
    x += block.narrow(rectified(block.widen(block.before_change(x))));
  }
  return logit_(last_(x)).col(0);
}

Eigen::ArrayXf StackClassifier::logits(const Published &map, const std::vector<uint32_t> &stacks,
                                       const MatrixXf &features) const {
  std::vector<std::vector<size_t>> members(1 + *std::max_element(stacks.begin(), stacks.end()));
  for (size_t i = 0; i < stacks.size(); ++i) members[stacks[i]].push_back(i);
  Eigen::ArrayXf logits(static_cast<Index>(stacks.size()));
  for (const std::vector<size_t> &stack : members) {
    const size_t parts = (stack.size() + kMostPoints - 1) / kMostPoints;
    for (size_t part = 0; part < parts; ++part) {
      std::vector<size_t> points;
      for (size_t k = part; k < stack.size(); k += parts) points.push_back(stack[k]);
      const Eigen::VectorXf found = ofStack(map, features, points);
      for (size_t k = 0; k < points.size(); ++k)
        logits[static_cast<Index>(points[k])] = found[static_cast<Index>(k)];
    }
  }
  return logits;
}

}  // namespace sphc::host
