// Tells real from fake points stack by stack: a small transformer over the points of a stack, which has learned on
// other places how the layers of a strategy's stacks differ.  What it knows of places is how far points are from
// each other, so turning or mirroring a stack changes nothing.
#pragma once
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

class StackClassifier {
 public:
  // Throws std::runtime_error when the file is no such model.
  explicit StackClassifier(const std::string &path);

  // A number a point, larger: rather real.  `stacks` of stacksOf, `features` of stackFeatures.
  Eigen::ArrayXf logits(const Published &map, const std::vector<uint32_t> &stacks,
                        const Eigen::MatrixXf &features) const;

 private:
  struct Linear {
    Linear(const nlohmann::json &json, Eigen::Index inputs);
    Eigen::MatrixXf operator()(const Eigen::MatrixXf &rows) const;
    Eigen::MatrixXf weights;  // a row an output
    Eigen::RowVectorXf bias;
  };
  struct Norm {
    Norm(const nlohmann::json &json, Eigen::Index size);
    Eigen::MatrixXf operator()(const Eigen::MatrixXf &rows) const;
    Eigen::RowVectorXf gain, bias;
  };
  struct Block {
    Block(const nlohmann::json &json, Eigen::Index width);
    Norm before_attention, before_change;
    Linear queries_keys_values, of_distance, mix, widen, narrow;
  };

  explicit StackClassifier(const nlohmann::json &json);
  Eigen::VectorXf ofStack(const Published &map, const Eigen::MatrixXf &features,
                          const std::vector<size_t> &points) const;
  static Eigen::MatrixXf attend(const Block &block, const Eigen::MatrixXf &x, const Eigen::MatrixXf &closeness);

  Eigen::RowVectorXf mean_, scale_;
  Linear looks_first_, looks_second_, told_;
  std::vector<Block> blocks_;
  Norm last_;
  Linear logit_;
};

}  // namespace sphc::host
