#include "host/audit/score/retrieval.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sphc::host {
namespace {

constexpr int kBins = 8;              // directions of an edge, its sign included
constexpr double kSmoothPx = 1.5;     // standard deviation, before gradients
constexpr double kKnown = 0.8;        // share of a cell that must be known
constexpr double kFaintEdges = 0.03;  // of the mean cell's edges: what is weaker hardly counts

// Of each cell, the roots of the shares of its edges' directions: one strong edge does not outweigh all others.
cv::Mat edgesOf(const cv::Mat &picture, int cells) {
  cv::Mat smooth, dx, dy, strength, angle;
  cv::GaussianBlur(picture, smooth, {}, kSmoothPx);
  cv::Sobel(smooth, dx, CV_32F, 1, 0);
  cv::Sobel(smooth, dy, CV_32F, 0, 1);
  cv::cartToPolar(dx, dy, strength, angle, true);
  cv::Mat edges(cells * cells, kBins, CV_32F, cv::Scalar(0));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const float bin = angle.at<float>(y, x) * kBins / 360, share = bin - std::floor(bin);
      const int first = static_cast<int>(bin) % kBins;
      auto *cell = edges.ptr<float>(y * cells / picture.rows * cells + x * cells / picture.cols);
      cell[first] += (1 - share) * strength.at<float>(y, x);
      cell[(first + 1) % kBins] += share * strength.at<float>(y, x);
    }
  }
  cv::Mat sums;
  cv::reduce(edges, sums, 1, cv::REDUCE_SUM);
  sums += kFaintEdges * cv::mean(sums)[0] + 1e-9;
  edges /= cv::repeat(sums, 1, kBins);
  cv::sqrt(edges, edges);
  return edges;
}

struct Known {
  Known(const TruthView &view, int cells) {
    cv::Mat filled = view.grey.clone(), inner, shares;
    filled.setTo(cv::mean(view.grey, view.seen)[0], ~view.seen);
    edges = edgesOf(filled, cells);
    cv::erode(view.seen, inner, cv::Mat::ones(5, 5, CV_8U));
    inner.convertTo(inner, CV_32F, 1.0 / 255);
    cv::resize(inner, shares, {cells, cells}, 0, 0, cv::INTER_AREA);
    known = cv::repeat(shares.reshape(1, cells * cells) > kKnown, 1, kBins);
  }
  cv::Mat edges, known;
};

// Correlation over the cells that are known.
double alike(const cv::Mat &edges, const Known &truth) {
  cv::Scalar mean_a, mean_b, deviation_a, deviation_b;
  cv::meanStdDev(edges, mean_a, deviation_a, truth.known);
  cv::meanStdDev(truth.edges, mean_b, deviation_b, truth.known);
  const double covariance = cv::mean(edges.mul(truth.edges), truth.known)[0] - mean_a[0] * mean_b[0];
  return covariance / std::max(deviation_a[0] * deviation_b[0], 1e-12);
}

}  // namespace

double standardErrorOfShare(double share, size_t count) {
  return std::sqrt(share * (1 - share) / std::max(1.0, static_cast<double>(count)));
}

Retrieval retrieve(const std::vector<cv::Mat> &pictures, const std::vector<TruthView> &truths, int cells) {
  std::vector<Known> known;
  for (const TruthView &truth : truths) known.emplace_back(truth, cells);
  Retrieval retrieval;
  for (size_t i = 0; i < pictures.size(); ++i) {
    const cv::Mat edges = edgesOf(pictures[i], cells);
    std::vector<double> scores;
    for (const Known &truth : known) scores.push_back(alike(edges, truth));
    const auto best = std::max_element(scores.begin(), scores.end());
    retrieval.hits.push_back(best != scores.end() && static_cast<size_t>(best - scores.begin()) == i);
  }
  const auto n = static_cast<double>(std::max<size_t>(1, pictures.size()));
  retrieval.top1 = static_cast<double>(std::count(retrieval.hits.begin(), retrieval.hits.end(), true)) / n;
  retrieval.standard_error = standardErrorOfShare(retrieval.top1, retrieval.hits.size());
  return retrieval;
}

}  // namespace sphc::host
