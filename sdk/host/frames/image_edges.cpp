#include "host/frames/image_edges.h"

#include <opencv2/imgproc.hpp>

namespace sphc::host {
namespace {

constexpr double kLowGradient = 40, kHighGradient = 100;  // Canny's two thresholds

}  // namespace

std::vector<uint8_t> imageEdges(const std::vector<uint8_t> &gray, uint32_t width, uint32_t height,
                                double sensitivity) {
  const cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_8U, const_cast<uint8_t *>(gray.data()));
  cv::Mat smooth, edges;
  cv::GaussianBlur(image, smooth, cv::Size(0, 0), 1);
  cv::Canny(smooth, edges, kLowGradient / sensitivity, kHighGradient / sensitivity);
  std::vector<uint8_t> found(gray.size());
  for (size_t i = 0; i < found.size(); ++i) found[i] = edges.data[i] != 0;
  return found;
}

std::vector<float> distancesToEdges(const std::vector<uint8_t> &edges, uint32_t width, uint32_t height) {
  cv::Mat elsewhere(static_cast<int>(height), static_cast<int>(width), CV_8U), distance;
  for (size_t i = 0; i < edges.size(); ++i) elsewhere.data[i] = edges[i] ? 0 : 1;
  cv::distanceTransform(elsewhere, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return {distance.ptr<float>(), distance.ptr<float>() + edges.size()};
}

}  // namespace sphc::host
