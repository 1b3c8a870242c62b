#include "host/recording/foreign/depth_lut.h"

#include <algorithm>
#include <cmath>

#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

[[noreturn]] void failLut(const char *why) {
  throw Failure(SPHC_E_ARGUMENT, std::string(why) + "; copy the file again");
}

// `kNumbers` floats for each pixel, and what `of` makes of them.
template <size_t kNumbers, typename Each, typename Of>
std::vector<Each> eachOf(ByteView file, const ImageSize &size, const char *misfit, Of &&of) {
  const size_t count = size_t{size.width} * size.height;
  if (file.size != count * kNumbers * sizeof(float)) failLut(misfit);
  std::vector<Each> all;
  all.reserve(count);
  for (const uint8_t *at = file.data; all.size() < count; at += kNumbers * sizeof(float)) {
    float stored[kNumbers];
    std::memcpy(stored, at, sizeof stored);
    double told[kNumbers];
    std::copy(std::begin(stored), std::end(stored), told);
    all.push_back(of(told));
  }
  return all;
}

// The line through points, by least squares.
class LineFit {
 public:
  void add(double x, double y) {
    n_ += 1;
    sx_ += x;
    sy_ += y;
    sxx_ += x * x;
    sxy_ += x * y;
  }
  double slope() const { return (n_ * sxy_ - sx_ * sy_) / (n_ * sxx_ - sx_ * sx_); }
  double start() const { return (sy_ - slope() * sx_) / n_; }

 private:
  double n_ = 0, sx_ = 0, sy_ = 0, sxx_ = 0, sxy_ = 0;
};

}  // namespace

DepthLut DepthLut::ofRays(ByteView file, const ImageSize &size) {
  const auto ray = [](const double *told) {
    const double x = told[0], y = told[1], z = told[2];
    return rayOf(x / z, y / z, z);
  };
  return DepthLut(eachOf<3, Ray>(file, size, "is not three floats for each pixel of the depth images", ray), size);
}

DepthLut DepthLut::ofPlanePoints(ByteView file, const ImageSize &size) {
  const auto ray = [](const double *told) {
    const double x = told[0], y = told[1];
    return rayOf(x, y, 1 / std::sqrt(x * x + y * y + 1));
  };
  return DepthLut(eachOf<2, Ray>(file, size, "is not two floats for each pixel of the depth images", ray), size);
}

DepthLut::Ray DepthLut::rayOf(double x, double y, double z) {
  const bool is_ray = z > 0 && z < 1.001 && std::abs(x) < 10 && std::abs(y) < 10;
  return is_ray ? Ray{x, y, std::min(1.0, z)} : Ray{0, 0, 0};
}

DepthLut::DepthLut(std::vector<Ray> rays, const ImageSize &size) : size_(size), rays_(std::move(rays)) {
  fitCamera();
  sources_.reserve(rays_.size());
  for (uint32_t v = 0; v < size.height; ++v)
    for (uint32_t u = 0; u < size.width; ++u) sources_.push_back(sourceOf(u, v));
}

void DepthLut::fitCamera() {
  constexpr double kMiddle = 0.25;  // of the plane at 1, some 14 degrees to each side
  LineFit across, down;
  for (size_t i = 0; i < rays_.size(); ++i) {
    const Ray &ray = rays_[i];
    if (ray.z == 0 || std::abs(ray.x) > kMiddle || std::abs(ray.y) > kMiddle) continue;
    across.add(ray.x, static_cast<double>(i % size_.width) + 0.5);
    down.add(ray.y, static_cast<double>(i / size_.width) + 0.5);
  }
  camera_ = {SPHC_CAMERA_PINHOLE,
             size_.width,
             size_.height,
             4,
             {across.slope(), down.slope(), across.start(), down.start()}};
  sphc_message message = {};
  if (sphc_camera_check(&camera_, &message) != SPHC_OK) failLut("its rays are those of no camera");
}

// Goes to the pixel whose ray is wanted, by how far the ray of the one where it stands is off.  At the rim, where
// rays are further apart, it may go to and fro between two; the nearest one counts, if it is within a pixel.
uint32_t DepthLut::sourceOf(uint32_t u, uint32_t v) const {
  constexpr int kMostSteps = 20;
  const double *p = camera_.params;
  const double x = (u + 0.5 - p[2]) / p[0], y = (v + 0.5 - p[3]) / p[1];
  double column = u, row = v, nearest_px = 1;
  uint32_t source = kNowhere;
  for (int step = 0; step < kMostSteps; ++step) {
    if (!(column >= 0 && row >= 0 && column < size_.width && row < size_.height)) break;
    const uint32_t at = static_cast<uint32_t>(row) * size_.width + static_cast<uint32_t>(column);
    const Ray &ray = rays_[at];
    if (ray.z == 0) break;
    const double across_px = p[0] * (x - ray.x), down_px = p[1] * (y - ray.y);
    const double off_px = std::max(std::abs(across_px), std::abs(down_px));
    if (off_px < nearest_px) source = at;
    nearest_px = std::min(nearest_px, off_px);
    if (off_px < 0.5) break;
    column += std::round(across_px);
    row += std::round(down_px);
  }
  return source;
}

void DepthLut::toPinhole(const std::vector<uint16_t> &range_mm, uint16_t *depth_mm) const {
  for (size_t i = 0; i < sources_.size(); ++i) {
    const uint32_t source = sources_[i];
    depth_mm[i] =
        source == kNowhere ? uint16_t{0} : static_cast<uint16_t>(std::lround(range_mm[source] * rays_[source].z));
  }
}

}  // namespace sphc::recording
