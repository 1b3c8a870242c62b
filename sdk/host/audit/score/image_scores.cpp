#include "host/audit/score/image_scores.h"

#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace sphc::host {
namespace {

constexpr double kMean = 0.5, kDeviation = 0.2;
constexpr double kEdgeShare = 0.1;  // of the pixels with the strongest gradients
constexpr int kEdgeReachPx = 2;
constexpr double kSiftReachPx = 4;
constexpr float kSiftRatio = 0.8f;

cv::Mat standardised(const cv::Mat &picture, const cv::Mat &seen) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture, mean, deviation, seen);
  cv::Mat result = (picture - mean[0]) * (kDeviation / std::max(deviation[0], 1e-9)) + kMean;
  result.setTo(kMean, ~seen);
  return result;
}

// Wang et al. 2004: windows of 11 x 11 under a Gaussian of 1.5 px; the mean over windows that are wholly known.
double ssimOf(const cv::Mat &a, const cv::Mat &b, const cv::Mat &seen) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const auto blur = [](const cv::Mat &image) {
    cv::Mat blurred;
    cv::GaussianBlur(image, blurred, {11, 11}, 1.5);
    return blurred;
  };
  const cv::Mat mean_a = blur(a), mean_b = blur(b);
  const cv::Mat mean_aa = mean_a.mul(mean_a), mean_bb = mean_b.mul(mean_b), mean_ab = mean_a.mul(mean_b);
  const cv::Mat var_a = blur(a.mul(a)) - mean_aa, var_b = blur(b.mul(b)) - mean_bb, cov = blur(a.mul(b)) - mean_ab;
  const cv::Mat above = (2 * mean_ab + kC1).mul(2 * cov + kC2);
  const cv::Mat below = (mean_aa + mean_bb + kC1).mul(var_a + var_b + kC2);
  cv::Mat whole;
  cv::erode(seen, whole, cv::Mat::ones(11, 11, CV_8U));
  return cv::countNonZero(whole) ? cv::mean(above / below, whole)[0] : 0;
}

cv::Mat edgesOf(const cv::Mat &picture, const cv::Mat &seen) {
  cv::Mat smooth, dx, dy, strength, inner;
  cv::GaussianBlur(picture, smooth, {}, 1);
  cv::Sobel(smooth, dx, CV_32F, 1, 0);
  cv::Sobel(smooth, dy, CV_32F, 0, 1);
  cv::magnitude(dx, dy, strength);
  cv::erode(seen, inner, cv::Mat::ones(7, 7, CV_8U));  // the border of what is known is no edge
  strength.setTo(0, ~inner);
  cv::Mat sorted;
  cv::sort(strength.reshape(1, 1), sorted, cv::SORT_EVERY_ROW | cv::SORT_DESCENDING);
  const int last = static_cast<int>(kEdgeShare * cv::countNonZero(inner));
  return strength > std::max(static_cast<double>(sorted.at<float>(last)), 1e-6);
}

void scoreEdges(const cv::Mat &picture, const cv::Mat &truth, const cv::Mat &seen, ImageScores *scores) {
  const cv::Mat wanted = edgesOf(truth, seen);
  cv::Mat near;
  cv::dilate(edgesOf(picture, seen), near, cv::Mat::ones(2 * kEdgeReachPx + 1, 2 * kEdgeReachPx + 1, CV_8U));
  const auto share = [&near](const cv::Mat &of) {
    const int all = cv::countNonZero(of);
    return all ? static_cast<double>(cv::countNonZero(near & of)) / all : 0.0;
  };
  scores->edge_recall = share(wanted);
  scores->edge_chance = share(seen);
}

double siftFound(const cv::Mat &picture, const cv::Mat &truth, const cv::Mat &seen) {
  const auto sift = cv::SIFT::create();
  const auto detect = [&](const cv::Mat &image, std::vector<cv::KeyPoint> *keypoints) {
    cv::Mat bytes, descriptors;
    image.convertTo(bytes, CV_8U, 255);
    sift->detectAndCompute(bytes, seen, *keypoints, descriptors);
    return descriptors;
  };
  std::vector<cv::KeyPoint> wanted, found;
  const cv::Mat wanted_descriptors = detect(truth, &wanted), found_descriptors = detect(picture, &found);
  if (wanted.empty() || found.size() < 2) return 0;
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_L2).knnMatch(wanted_descriptors, found_descriptors, matches, 2);
  size_t good = 0;
  for (const auto &match : matches) {
    const cv::Point2f there = wanted[static_cast<size_t>(match[0].queryIdx)].pt;
    const cv::Point2f here = found[static_cast<size_t>(match[0].trainIdx)].pt;
    if (match[0].distance < kSiftRatio * match[1].distance && cv::norm(there - here) < kSiftReachPx) ++good;
  }
  return static_cast<double>(good) / static_cast<double>(wanted.size());
}

}  // namespace

ImageScores scoreImage(const cv::Mat &picture, const TruthView &view) {
  const cv::Mat a = standardised(picture, view.seen), b = standardised(view.grey, view.seen);
  const double pixels = std::max(1, cv::countNonZero(view.seen));
  ImageScores scores;
  scores.mae = cv::norm(a, b, cv::NORM_L1, view.seen) / pixels;
  const double mse = std::pow(cv::norm(a, b, cv::NORM_L2, view.seen), 2) / pixels;
  scores.psnr_db = -10 * std::log10(std::max(mse, 1e-10));
  scores.ncc = cv::mean((a - kMean).mul(b - kMean), view.seen)[0] / (kDeviation * kDeviation);
  scores.ssim = ssimOf(a, b, view.seen);
  scoreEdges(a, b, view.seen, &scores);
  scores.sift_found = siftFound(a, b, view.seen);
  return scores;
}

}  // namespace sphc::host
