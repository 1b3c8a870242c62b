#include "host/audit/score/retrieval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {
namespace {

constexpr int kLow = 32, kCells = 8, kBins = 8;
constexpr int kCellPx = VirtualCamera::kSide / kCells;
constexpr float kKnown = 0.9f;        // share of a low-resolution pixel or cell that must be known
constexpr float kFaintEdges = 0.03f;  // of the mean energy of edges: what is weaker does not count

struct Signature {
  cv::Mat low;                                         // kLow x kLow
  std::array<float, kCells * kCells * kBins> edges{};  // energy by cell and direction
};

cv::Mat blurred(const cv::Mat &picture, double sigma) {
  cv::Mat result;
  cv::GaussianBlur(picture, result, {}, sigma);
  return result;
}

cv::Mat shrunk(const cv::Mat &picture, int side) {
  cv::Mat result;
  cv::resize(picture, result, {side, side}, 0, 0, cv::INTER_AREA);
  return result;
}

Signature signatureOf(const cv::Mat &picture) {
  Signature signature;
  signature.low = shrunk(blurred(picture, 2), kLow);
  cv::Mat dx, dy, strength, angle;
  const cv::Mat smooth = blurred(picture, 1.5);
  cv::Sobel(smooth, dx, CV_32F, 1, 0);
  cv::Sobel(smooth, dy, CV_32F, 0, 1);
  cv::cartToPolar(dx, dy, strength, angle, true);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const float bin = angle.at<float>(y, x) * kBins / 360, share = bin - std::floor(bin);
      const int first = static_cast<int>(bin) % kBins;
      float *cell = &signature.edges[static_cast<size_t>((y / kCellPx * kCells + x / kCellPx) * kBins)];
      cell[first] += (1 - share) * strength.at<float>(y, x);
      cell[(first + 1) % kBins] += share * strength.at<float>(y, x);
    }
  }
  return signature;
}

double correlation(const std::vector<double> &a, const std::vector<double> &b) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  const auto n = static_cast<double>(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i];
    sum_b += b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
    ab += a[i] * b[i];
  }
  const double variances = (aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n);
  return variances > 1e-12 ? (ab - sum_a * sum_b / n) / std::sqrt(variances) : 0;
}

// A truth with what is unknown filled with the mean, and where it is known.
struct Known {
  explicit Known(const TruthView &view) {
    cv::Mat filled = view.grey.clone(), seen, inner;
    filled.setTo(cv::mean(view.grey, view.seen)[0], ~view.seen);
    signature = signatureOf(filled);
    view.seen.convertTo(seen, CV_32F, 1.0 / 255);
    low = shrunk(blurred(seen, 2), kLow);
    cv::erode(seen, inner, cv::Mat::ones(5, 5, CV_8U));
    cells = shrunk(inner, kCells);
  }
  Signature signature;
  cv::Mat low, cells;
};

double alikeAtLowResolution(const Signature &picture, const Known &truth) {
  std::vector<double> a, b;
  for (int i = 0; i < kLow * kLow; ++i) {
    if (!(truth.low.at<float>(i / kLow, i % kLow) > kKnown)) continue;
    a.push_back(static_cast<double>(picture.low.at<float>(i / kLow, i % kLow)));
    b.push_back(static_cast<double>(truth.signature.low.at<float>(i / kLow, i % kLow)));
  }
  return correlation(a, b);
}

// Roots of each cell's shares, so that one strong edge does not outweigh all others.
void appendShares(const Signature &signature, int cell, std::vector<double> *shares) {
  float all = 0, sum = 0;
  for (const float edge : signature.edges) all += edge;
  const float *edges = &signature.edges[static_cast<size_t>(cell * kBins)];
  for (int k = 0; k < kBins; ++k) sum += edges[k];
  const float divisor = sum + kFaintEdges * all / (kCells * kCells) + 1e-9f;
  for (int k = 0; k < kBins; ++k) shares->push_back(std::sqrt(static_cast<double>(edges[k] / divisor)));
}

double alikeInEdges(const Signature &picture, const Known &truth) {
  std::vector<double> a, b;
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    if (!(truth.cells.at<float>(cell / kCells, cell % kCells) > kKnown)) continue;
    appendShares(picture, cell, &a);
    appendShares(truth.signature, cell, &b);
  }
  return correlation(a, b);
}

}  // namespace

Retrieval retrieve(const std::vector<cv::Mat> &pictures, const std::vector<TruthView> &truths) {
  const std::vector<Known> known(truths.begin(), truths.end());
  Retrieval retrieval;
  for (size_t i = 0; i < pictures.size(); ++i) {
    const Signature signature = signatureOf(pictures[i]);
    std::vector<double> alike;
    for (const Known &truth : known)
      alike.push_back(alikeAtLowResolution(signature, truth) + alikeInEdges(signature, truth));
    const auto best = std::max_element(alike.begin(), alike.end());
    retrieval.hits.push_back(best != alike.end() && static_cast<size_t>(best - alike.begin()) == i);
  }
  const auto n = static_cast<double>(std::max<size_t>(1, pictures.size()));
  retrieval.top1 = static_cast<double>(std::count(retrieval.hits.begin(), retrieval.hits.end(), true)) / n;
  retrieval.standard_error = std::sqrt(retrieval.top1 * (1 - retrieval.top1) / n);
  return retrieval;
}

}  // namespace sphc::host
