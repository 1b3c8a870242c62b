#include "lab/confidence/fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr int kUnknowns = kConfidenceFeatures + 1, kSteps = 50;
constexpr double kRidge = 0.1;  // keeps weights finite where right and wrong can be parted
using Weights = Eigen::Matrix<double, kUnknowns, 1>;
using Hessian = Eigen::Matrix<double, kUnknowns, kUnknowns>;

struct Sample {
  Weights x;  // 1, then the features
  double y;
};

std::vector<Sample> samplesOf(const std::vector<ConfidenceRun> &runs) {
  std::vector<Sample> samples;
  size_t correct = 0;
  for (const ConfidenceRun &run : runs) {
    ConfidenceFeatures features;
    if (!confidenceFeatures(run.inputs, &features)) continue;
    Sample sample = {Weights::Ones(), run.correct ? 1.0 : 0.0};
    for (int k = 0; k < kConfidenceFeatures; ++k) sample.x[k + 1] = features.value[k];
    samples.push_back(sample);
    correct += run.correct;
  }
  if (correct == 0 || correct == samples.size())
    throw std::runtime_error("cannot fit: all poses are right, or all wrong; give more or harder queries");
  return samples;
}

// Newton's method on the log likelihood over the features that are in use.
Weights fit(const std::vector<Sample> &samples, const Weights &used) {
  Weights w = Weights::Zero();
  for (int step = 0; step < kSteps; ++step) {
    Hessian h = Hessian::Zero();
    Weights g = -kRidge * w;
    h.diagonal().setConstant(kRidge);
    for (const Sample &sample : samples) {
      const Weights x = sample.x.cwiseProduct(used);
      const double p = 1 / (1 + std::exp(-w.dot(x)));
      g += (sample.y - p) * x;
      h += std::max(p * (1 - p), 1e-9) * x * x.transpose();
    }
    const Weights change = h.ldlt().solve(g);
    w += change * std::min(1.0, 4 / change.norm());
    if (change.norm() < 1e-10) break;
  }
  return w;
}

}  // namespace

ConfidenceModel fitConfidence(const std::vector<ConfidenceRun> &runs) {
  const std::vector<Sample> samples = samplesOf(runs);
  Weights used = Weights::Ones(), w = fit(samples, used);
  for (int worst = 0; w.tail<kConfidenceFeatures>().minCoeff(&worst) < 0;) {
    used[worst + 1] = 0;
    w = fit(samples, used);
  }
  ConfidenceModel model = {w[0], {}};
  for (int k = 0; k < kConfidenceFeatures; ++k) model.weight[k] = w[k + 1];
  return model;
}

std::string modelText(const ConfidenceModel &model) {
  std::string text = "constexpr ConfidenceModel kModel = {" + fixed(model.intercept, 4) + ", {";
  for (int k = 0; k < kConfidenceFeatures; ++k) text += (k ? ", " : "") + fixed(model.weight[k], 4);
  return text + "}};";
}

}  // namespace sphc::host
