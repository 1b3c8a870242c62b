#include "host/live/geometry_check.h"

#include <algorithm>
#include <cstring>
#include <spherecloud/spherecloud.hpp>

#include "host/base/checked_call.h"
#include "host/frames/align_edges.h"
#include "host/recording/calibration_json.h"
#include "host/report/run.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

constexpr size_t kFewestEdges = 300;
constexpr double kClearly = 0.7;  // of the distance as calibrated, or by chance
constexpr double kSurely = 0.5;   // of the distance by chance: five mistakes are tried, and one is lucky
constexpr double kFine_px = 4;    // as calibrated
constexpr double kFewestApart_px =
    2;  // a median pixel nearer to an edge than this is in an image of nothing but edges
constexpr uint32_t kChanceStep_px = 5;
constexpr uint32_t kGap_px = 10;
constexpr double kMeasured = 0.2, kHardlyReached = 0.02;  // shares of pixels

std::vector<uint8_t> grayOf(const sphc_image &image) {
  const size_t channels = image.format == SPHC_FORMAT_GRAY8 ? 1 : 3;
  std::vector<uint8_t> gray(size_t{image.width} * image.height);
  for (uint32_t y = 0; y < image.height; ++y) {
    const auto *row = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    for (uint32_t x = 0; x < image.width; ++x)  // green is nearly grey
      gray[size_t{y} * image.width + x] = row[channels * x + (channels == 3 ? 1 : 0)];
  }
  return gray;
}

size_t withDepth(const std::vector<uint16_t> &depth) {
  return depth.size() - static_cast<size_t>(std::count(depth.begin(), depth.end(), 0));
}

std::vector<uint16_t> flipped(const sphc_image &depth, bool left_right, bool up_down) {
  std::vector<uint16_t> out(size_t{depth.width} * depth.height);
  for (uint32_t y = 0; y < depth.height; ++y) {
    const uint32_t from = up_down ? depth.height - 1 - y : y;
    uint16_t *row = &out[size_t{y} * depth.width];
    std::memcpy(row, static_cast<const uint8_t *>(depth.data) + size_t{from} * depth.stride_bytes,
                size_t{2} * depth.width);
    if (left_right) std::reverse(row, row + depth.width);
  }
  return out;
}

}  // namespace

GeometryCheck::GeometryCheck(const sphc_rig &calibration) : calibration_(calibration) {}

bool GeometryCheck::canBe(Mistake mistake) const {
  const sphc_camera &color = calibration_.color_camera, &depth = calibration_.depth_camera;
  const bool registered = recording::isRegistered(calibration_);
  if (mistake == kRegistered) return !registered && color.width == depth.width && color.height == depth.height;
  return mistake != kInverse || !registered;
}

sphc_rig GeometryCheck::calibrationOf(Mistake mistake) const {
  sphc_rig calibration = calibration_;
  if (mistake == kRegistered) {
    calibration.depth_camera = calibration.color_camera;
    calibration.color_from_depth = {{1, 0, 0, 0}, {0, 0, 0}};
  }
  if (mistake == kInverse) sphc_rigid_inverse(&calibration_.color_from_depth, &calibration.color_from_depth);
  return calibration;
}

std::vector<uint16_t> GeometryCheck::aligned(const sphc_image &depth, Mistake mistake) const {
  sphc_aligner_config config;
  sphc_aligner_config_init(&config, sizeof config);
  config.rig = calibrationOf(mistake);
  sphc_memory need = {};
  orThrow("aligner", [&](sphc_message *message) { return sphc_aligner_memory(&config, &need, message); });
  spherecloud::AlignedBuffer memory(need.state_bytes, need.alignment);
  sphc_aligner *aligner = nullptr;
  orThrow("aligner", [&](sphc_message *message) {
    return sphc_aligner_init(memory.data(), memory.size(), &config, &aligner, message);
  });
  const std::vector<uint16_t> turned =
      flipped(depth, mistake == kMirrored || mistake == kTurned, mistake == kUpsideDown || mistake == kTurned);
  sphc_image image = depth;
  image.data = turned.data();
  image.stride_bytes = 2 * image.width;
  std::vector<uint16_t> out(size_t{config.rig.color_camera.width} * config.rig.color_camera.height);
  sphc_aligned wanted = {};
  wanted.struct_size = sizeof wanted;
  wanted.depth = out.data();
  wanted.depth_stride_bytes = 2 * config.rig.color_camera.width;
  const sphc_status status = sphc_aligner_process(aligner, &image, &wanted);
  if (status < 0) throw std::runtime_error(std::string("depth: ") + sphc_aligner_message(aligner));
  return out;
}

// Does hardly any of the depth that was measured lie in the image?
bool GeometryCheck::missesTheImage() const {
  return static_cast<double>(measured_) > kMeasured * static_cast<double>(in_depth_) &&
         static_cast<double>(reached_) < kHardlyReached * static_cast<double>(in_image_);
}

void GeometryCheck::look(const sphc_image &color, const sphc_image &depth) {
  const std::vector<uint8_t> edges = imageEdges(grayOf(color), color.width, color.height);
  const auto edge_count = static_cast<size_t>(std::count(edges.begin(), edges.end(), 1));
  if (edge_count == 0) return;
  image_edges_ += edge_count;
  measured_ += withDepth(flipped(depth, false, false));
  in_depth_ += size_t{depth.width} * depth.height;
  std::vector<uint8_t> any(edges.size());
  for (size_t i = 0; i < any.size(); i += kChanceStep_px) any[i] = 1;
  edgeDistances(any, edges, color.width, color.height, &chance_px_);
  for (int mistake = 0; mistake < kMistakes; ++mistake) {
    if (!canBe(static_cast<Mistake>(mistake))) continue;
    const std::vector<uint16_t> lies = aligned(depth, static_cast<Mistake>(mistake));
    if (mistake == kNone) {
      reached_ += withDepth(lies);
      in_image_ += lies.size();
    }
    edgeDistances(depthEdges(lies, color.width, color.height, kGap_px), edges, color.width, color.height,
                  &distances_px_[static_cast<size_t>(mistake)]);
  }
}

std::optional<Finding> GeometryCheck::nothingToTell() const {
  if (image_edges_ < kFewestEdges)
    return Finding{
        Finding::Grade::kDoubtful, "geometry",
        "too few edges in the image to tell; is it black, blank or out of focus? Show the cameras a room with "
        "things in it"};
  if (percentile(chance_px_, 0.5) < kFewestApart_px)
    return Finding{Finding::Grade::kDoubtful, "geometry",
                   "the image is edges all over, as noise is, so nothing can be told; more light, less gain"};
  return std::nullopt;
}

Finding GeometryCheck::finding() const {
  const char *const kNames[kMistakes] = {
      "as calibrated",
      "depth mirrored left to right; turn mirroring off in the camera, or flip the image",
      "depth upside down; turn it, or the camera",
      "depth turned by half a turn; turn it, or the camera",
      "depth registered to colour by the camera already; say so in the calibration (\"depth_registered\": true), "
      "or "
      "turn registration off",
      "color_from_depth the wrong way round; it should take points of the depth camera to the colour camera"};
  if (const std::optional<Finding> nothing = nothingToTell()) return *nothing;
  const double chance_px = percentile(chance_px_, 0.5);
  std::array<double, kMistakes> medians_px;
  for (size_t i = 0; i < kMistakes; ++i) {
    medians_px[i] = distances_px_[i].size() < kFewestEdges ? 1e9 : percentile(distances_px_[i], 0.5);
  }
  const double calibrated_px = medians_px[kNone];
  const size_t best =
      static_cast<size_t>(std::min_element(medians_px.begin(), medians_px.end()) - medians_px.begin());
  const bool too_few = distances_px_[kNone].size() < kFewestEdges;
  if (too_few && missesTheImage())
    return {
        Finding::Grade::kWrong, "geometry",
        "as calibrated, depth falls beside the image; give focal lengths and centres in pixels of images of this "
        "size, t_m of color_from_depth in metres, and the depth_unit_m of these images"};
  if (too_few && (best == kNone || distances_px_[best].size() < 3 * kFewestEdges))
    return {Finding::Grade::kDoubtful, "geometry",
            "too few edges in depth to tell; show the cameras a room with things in it, 1 to 3 m away"};
  const std::string seen = too_few
                               ? "hardly an edge of depth lies in the image"
                               : "edges of depth lie " + fixed(calibrated_px, 1) + " px from edges of the image";
  if (best != kNone && medians_px[best] < kClearly * calibrated_px && medians_px[best] < kSurely * chance_px)
    return {Finding::Grade::kWrong, "geometry",
            seen + " as calibrated, and " + fixed(medians_px[best], 1) + " px if it is " + kNames[best]};
  if (calibrated_px > kClearly * chance_px)
    return {Finding::Grade::kWrong, "geometry",
            seen + ", and any pixel does within " + fixed(chance_px, 1) +
                " px: the two show different things. Is depth stale, late or mere noise, or the calibration of "
                "other cameras?"};
  if (calibrated_px > kFine_px)
    return {Finding::Grade::kDoubtful, "geometry",
            seen + "; 1 to 3 px are usual: is this these cameras' calibration?"};
  return {Finding::Grade::kFine, "geometry", seen + "; no mirroring, turning or registration would do better"};
}

}  // namespace sphc::host
