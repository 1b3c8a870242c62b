#include "host/audit/attack/inversion.h"

#include <cmath>
#include <stdexcept>

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {
namespace {

// As in train/network.py.
constexpr int kCellSide = 2, kGrid = VirtualCamera::kSide / kCellSide;
constexpr int kInput = kDescriptorBytes + 2, kEmbedded = 24;
constexpr float kDescriptorScale = 1.0f / 128;

cv::dnn::Net readNet(const std::string &path) {
  try {
    return cv::dnn::readNetFromONNX(path);
  } catch (const cv::Exception &) {
    throw std::runtime_error("the network " + path +
                             " cannot be read; install the command anew, or give --networks");
  }
}

struct Cell {
  int x, y;
};

Cell cellOf(const Vector2 &pixel_px) {
  return {static_cast<int>(pixel_px.x()) / kCellSide, static_cast<int>(pixel_px.y()) / kCellSide};
}

// What the embedding is told of each keypoint.
cv::Mat describe(const SeenPoints &seen) {
  cv::Mat input(static_cast<int>(seen.pixels_px.size()), kInput, CV_32F);
  for (size_t i = 0; i < seen.pixels_px.size(); ++i) {
    auto *row = input.ptr<float>(static_cast<int>(i));
    for (size_t k = 0; k < kDescriptorBytes; ++k) row[k] = kDescriptorScale * seen.descriptors[i].bytes[k];
    const Cell cell = cellOf(seen.pixels_px[i]);
    row[kDescriptorBytes] = static_cast<float>(seen.pixels_px[i].x() / kCellSide - cell.x - 0.5);
    row[kDescriptorBytes + 1] = static_cast<float>(seen.pixels_px[i].y() / kCellSide - cell.y - 0.5);
  }
  return input;
}

}  // namespace

SeenPoints see(const std::vector<Vector3> &points, const std::vector<Descriptor> &descriptors,
               const std::vector<float> &weights, const Rigid &camera_from_map) {
  if (descriptors.size() != points.size() || (!weights.empty() && weights.size() != points.size()))
    throw std::invalid_argument("see: one descriptor a point is needed, and one weight or none at all");
  SeenPoints seen;
  for (size_t i = 0; i < points.size(); ++i) {
    const float weight = weights.empty() ? 1.0f : weights[i];
    Vector2 pixel;
    if (!(weight > 0) || !VirtualCamera::project(camera_from_map * points[i], &pixel)) continue;
    seen.pixels_px.push_back(pixel);
    seen.descriptors.push_back(descriptors[i]);
    seen.weights.push_back(weight);
  }
  return seen;
}

Inverter::Inverter(const std::string &folder, const std::string &name)
    : embedding_(readNet(folder + "/" + name + ".embedding.onnx")),
      painter_(readNet(folder + "/" + name + ".painter.onnx")) {}

// The weighted mean of the embedded keypoints in each cell, and how many there are: 1 x planes x grid x grid.
cv::Mat Inverter::planes(const SeenPoints &seen) {
  const int size[] = {1, kEmbedded + 1, kGrid, kGrid};
  cv::Mat planes(4, size, CV_32F, cv::Scalar(0)), count(kGrid, kGrid, CV_32F, cv::Scalar(0));
  embedding_.setInput(describe(seen));
  const cv::Mat embedded = embedding_.forward();
  const auto plane = [&planes](int k) { return cv::Mat(kGrid, kGrid, CV_32F, planes.ptr<float>(0, k)); };
  for (size_t i = 0; i < seen.pixels_px.size(); ++i) {
    const Cell cell = cellOf(seen.pixels_px[i]);
    const auto *numbers = embedded.ptr<float>(static_cast<int>(i));
    for (int k = 0; k < kEmbedded; ++k) plane(k).at<float>(cell.y, cell.x) += seen.weights[i] * numbers[k];
    count.at<float>(cell.y, cell.x) += seen.weights[i];
  }
  const cv::Mat divisor = cv::max(count, 1e-6);
  for (int k = 0; k < kEmbedded; ++k) {
    cv::Mat mean = plane(k);
    cv::divide(mean, divisor, mean);
  }
  cv::Mat saturating = plane(kEmbedded);
  cv::divide(count, count + 1, saturating);
  return planes;
}

cv::Mat Inverter::paint(const SeenPoints &seen) {
  cv::Mat picture(VirtualCamera::kSide, VirtualCamera::kSide, CV_32F, cv::Scalar(0));
  if (seen.pixels_px.empty()) return picture;
  painter_.setInput(planes(seen));
  const cv::Mat quarters = painter_.forward();  // the four pixels of each cell, rows first
  for (int y = 0; y < VirtualCamera::kSide; ++y) {
    for (int x = 0; x < VirtualCamera::kSide; ++x) {
      const int quarter = kCellSide * (y % kCellSide) + x % kCellSide;
      picture.at<float>(y, x) = quarters.ptr<float>(0, quarter)[y / kCellSide * kGrid + x / kCellSide];
    }
  }
  return picture;
}

}  // namespace sphc::host
