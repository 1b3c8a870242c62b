#include "host/live/geometry_check.h"

#include <algorithm>
#include <cstring>
#include <spherecloud/spherecloud.hpp>

#include "host/base/checked_call.h"
#include "host/base/median.h"
#include "host/frames/image_edges.h"
#include "host/live/depth_edge_points.h"
#include "host/recording/calibration_json.h"
#include "host/report/run.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

constexpr size_t kFewestEdges = 300;
constexpr double kClearly = 0.7;  // of the distance as calibrated, or by chance
constexpr double kSurely = 0.5;   // of the distance by chance: five mistakes are tried, and one is lucky
// Median distances as calibrated.
constexpr double kUsual_px = 3;       // where depth is not much coarser than colour
constexpr double kUsualShare = 0.75;  // of a pixel of depth, where it is
constexpr double kBeyondUsual_px = 1;
constexpr double kLeastWidth_px = 480,
                 kLeastHeight_px = 360;  // of colour, where it is looked at as coarsely as depth
constexpr double kFewestApart_px =
    2;  // a median pixel nearer to an edge than this is in an image of nothing but edges
constexpr uint32_t kChanceStep_px = 5;
// In dim light edges have less contrast: fainter ones count too, until a median pixel is as near to one as this.
constexpr double kSparse_px = 8, kMostSensitive = 4, kMoreSensitive = 1.25;
constexpr double kMeasured = 0.2, kHardlyReached = 0.02;  // shares of pixels

// Means of squares of `square` pixels; what is left over on the right and below is left out.
std::vector<uint8_t> grayOf(const sphc_image &image, uint32_t square) {
  const uint32_t channels = image.format == SPHC_FORMAT_GRAY8 ? 1 : 3;
  const uint32_t width = image.width / square, height = image.height / square;
  std::vector<uint32_t> sums(size_t{width} * height);
  for (uint32_t y = 0; y < height * square; ++y) {
    const auto *row = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    for (uint32_t x = 0; x < width * square; ++x)  // green is nearly grey
      sums[size_t{y / square} * width + x / square] += row[channels * x + (channels == 3 ? 1 : 0)];
  }
  std::vector<uint8_t> gray(sums.size());
  std::transform(sums.begin(), sums.end(), gray.begin(),
                 [square](uint32_t sum) { return static_cast<uint8_t>(sum / (square * square)); });
  return gray;
}

// The camera of such means.
sphc_camera shrunk(const sphc_camera &camera, uint32_t square) {
  sphc_camera result = camera;
  result.width = camera.width / square;
  result.height = camera.height / square;
  for (int i = 0; i < 4; ++i) result.params[i] = camera.params[i] / square;
  return result;
}

// Pixels of colour across one of depth.
double coarsenessOf(const sphc_rig &rig) { return rig.color_camera.params[0] / rig.depth_camera.params[0]; }

// Fine texture has edges all over, which hide those of coarse depth.
uint32_t squareOf(const sphc_rig &rig) {
  const double most = std::min(rig.color_camera.width / kLeastWidth_px, rig.color_camera.height / kLeastHeight_px);
  return static_cast<uint32_t>(std::max(1.0, std::min(most, coarsenessOf(rig))));
}

bool isIdentity(const sphc_rigid &rigid) {
  const auto is_zero = [](double value) { return value == 0; };
  return std::all_of(rigid.q_wxyz + 1, rigid.q_wxyz + 4, is_zero) && std::all_of(rigid.t_m, rigid.t_m + 3, is_zero);
}

// What is tried, in the order of Mistake.
constexpr const char *kMistakeNames[] = {
    "as calibrated",
    "depth mirrored left to right; turn mirroring off in the camera, or flip the image",
    "depth upside down; turn it, or the camera",
    "depth turned by half a turn; turn it, or the camera",
    "depth registered to colour by the camera already; say so in the calibration (\"depth_registered\": true), "
    "or turn registration off",
    "color_from_depth the wrong way round; it should take points of the depth camera to the colour camera"};

size_t withDepth(const std::vector<uint16_t> &depth) {
  return depth.size() - static_cast<size_t>(std::count(depth.begin(), depth.end(), 0));
}

std::vector<uint16_t> packed(const sphc_image &depth) {
  std::vector<uint16_t> out(size_t{depth.width} * depth.height);
  for (uint32_t y = 0; y < depth.height; ++y)
    std::memcpy(&out[size_t{y} * depth.width],
                static_cast<const uint8_t *>(depth.data) + size_t{y} * depth.stride_bytes, size_t{2} * depth.width);
  return out;
}

}  // namespace

GeometryCheck::GeometryCheck(const sphc_rig &calibration)
    : calibration_(calibration),
      square_(squareOf(calibration)),
      compared_(shrunk(calibration.color_camera, square_)),
      usual_px_(std::max(kUsual_px, kUsualShare * coarsenessOf(calibration))) {}

bool GeometryCheck::canBe(Mistake mistake) const {
  const sphc_camera &color = calibration_.color_camera, &depth = calibration_.depth_camera;
  if (mistake == kRegistered)
    return !recording::isRegistered(calibration_) && color.width == depth.width && color.height == depth.height;
  return mistake != kInverse || !isIdentity(calibration_.color_from_depth);
}

// With the colour camera of what is compared.
sphc_rig GeometryCheck::calibrationOf(Mistake mistake) const {
  sphc_rig calibration = calibration_;
  calibration.color_camera = compared_;
  if (mistake == kRegistered) {
    calibration.depth_camera = calibration_.color_camera;
    calibration.color_from_depth = {{1, 0, 0, 0}, {0, 0, 0}};
  }
  if (mistake == kInverse) sphc_rigid_inverse(&calibration_.color_from_depth, &calibration.color_from_depth);
  return calibration;
}

// Where an edge of depth falls in the image.
std::optional<GeometryCheck::Pixel> GeometryCheck::projected(const DepthEdgePoint &edge, Mistake mistake,
                                                             const sphc_rig &rig) const {
  const sphc_camera &depth = rig.depth_camera, &color = rig.color_camera;
  const bool mirrored = mistake == kMirrored || mistake == kTurned;
  const bool upside_down = mistake == kUpsideDown || mistake == kTurned;
  const double from_px[2] = {mirrored ? depth.width - edge.x_px : edge.x_px,
                             upside_down ? depth.height - edge.y_px : edge.y_px};
  double bearing[3], point_m[3], px[2];
  if (sphc_camera_unproject(&depth, from_px, bearing) != SPHC_OK) return std::nullopt;
  for (double &c : bearing) c *= edge.near * rig.depth_unit_m / bearing[2];
  sphc_rigid_apply(&rig.color_from_depth, bearing, point_m);
  if (sphc_camera_project(&color, point_m, px) != SPHC_OK) return std::nullopt;
  if (!(px[0] >= 0 && px[1] >= 0 && px[0] < color.width && px[1] < color.height)) return std::nullopt;
  return Pixel{static_cast<uint32_t>(px[0]), static_cast<uint32_t>(px[1])};
}

// As calibrated.
std::vector<uint16_t> GeometryCheck::aligned(const sphc_image &depth) const {
  sphc_aligner_config config;
  sphc_aligner_config_init(&config, sizeof config);
  config.rig = calibrationOf(kNone);
  sphc_memory need = {};
  orThrow("aligner", [&](sphc_message *message) { return sphc_aligner_memory(&config, &need, message); });
  spherecloud::AlignedBuffer memory(need.state_bytes, need.alignment);
  sphc_aligner *aligner = nullptr;
  orThrow("aligner", [&](sphc_message *message) {
    return sphc_aligner_init(memory.data(), memory.size(), &config, &aligner, message);
  });
  std::vector<uint16_t> out(size_t{config.rig.color_camera.width} * config.rig.color_camera.height);
  sphc_aligned wanted = {};
  wanted.struct_size = sizeof wanted;
  wanted.depth = out.data();
  wanted.depth_stride_bytes = 2 * config.rig.color_camera.width;
  const sphc_status status = sphc_aligner_process(aligner, &depth, &wanted);
  if (status < 0) throw std::runtime_error(std::string("depth: ") + sphc_aligner_message(aligner));
  return out;
}

// Does hardly any of the depth that was measured lie in the image?
bool GeometryCheck::missesTheImage() const {
  return static_cast<double>(measured_) > kMeasured * static_cast<double>(in_depth_) &&
         static_cast<double>(reached_) < kHardlyReached * static_cast<double>(in_image_);
}

void GeometryCheck::look(const sphc_image &color, const sphc_image &depth) {
  const uint32_t width = compared_.width, height = compared_.height;
  const std::vector<uint8_t> gray = grayOf(color, square_);
  std::vector<uint8_t> edges;
  std::vector<float> distance_px;
  for (double sensitivity = 1; sensitivity <= kMostSensitive; sensitivity *= kMoreSensitive) {
    edges = imageEdges(gray, width, height, sensitivity);
    distance_px = distancesToEdges(edges, width, height);
    if (median({distance_px.begin(), distance_px.end()}) <= kSparse_px) break;
  }
  const auto edge_count = static_cast<size_t>(std::count(edges.begin(), edges.end(), 1));
  if (edge_count == 0) return;
  image_edges_ += edge_count;
  for (size_t i = 0; i < distance_px.size(); i += kChanceStep_px)
    chance_px_.push_back(static_cast<double>(distance_px[i]));
  const std::vector<uint16_t> measured = packed(depth), lies = aligned(depth);
  measured_ += withDepth(measured);
  in_depth_ += measured.size();
  reached_ += withDepth(lies);
  in_image_ += lies.size();
  const std::vector<DepthEdgePoint> points =
      depthEdgePoints(measured, depth.width, depth.height, calibration_.depth_camera.params[0]);
  for (int mistake = 0; mistake < kMistakes; ++mistake) {
    if (!canBe(static_cast<Mistake>(mistake))) continue;
    const sphc_rig rig = calibrationOf(static_cast<Mistake>(mistake));
    for (const DepthEdgePoint &point : points)
      if (const std::optional<Pixel> at = projected(point, static_cast<Mistake>(mistake), rig))
        distances_px_[static_cast<size_t>(mistake)].push_back(
            static_cast<double>(distance_px[size_t{at->y} * width + at->x]));
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
  if (const std::optional<Finding> nothing = nothingToTell()) return *nothing;
  const double chance_px = percentile(chance_px_, 0.5);
  const auto in_px = [this](double compared_px) { return fixed(compared_px * square_, 1); };
  std::array<double, kMistakes> medians_px;
  for (size_t i = 0; i < kMistakes; ++i) {
    medians_px[i] = distances_px_[i].size() < kFewestEdges ? 1e9 : percentile(distances_px_[i], 0.5);
  }
  const double calibrated_px = medians_px[kNone];
  const size_t best =
      static_cast<size_t>(std::min_element(medians_px.begin(), medians_px.end()) - medians_px.begin());
  const bool too_few = distances_px_[kNone].size() < kFewestEdges;
  if (missesTheImage())
    return {
        Finding::Grade::kWrong, "geometry",
        "as calibrated, depth falls beside the image; give focal lengths and centres in pixels of images of this "
        "size, t_m of color_from_depth in metres, and the depth_unit_m of these images"};
  if (too_few && (best == kNone || distances_px_[best].size() < 3 * kFewestEdges))
    return {Finding::Grade::kDoubtful, "geometry",
            "too few edges in depth to tell; show the cameras a room with things in it, 1 to 3 m away"};
  const std::string seen = too_few ? "hardly an edge of depth lies in the image"
                                   : "edges of depth lie " + in_px(calibrated_px) + " px from edges of the image";
  if (best != kNone && medians_px[best] < kClearly * calibrated_px && medians_px[best] < kSurely * chance_px)
    return {Finding::Grade::kWrong, "geometry",
            seen + " as calibrated, and " + in_px(medians_px[best]) + " px if it is " + kMistakeNames[best]};
  if (calibrated_px > kClearly * chance_px)
    return {Finding::Grade::kWrong, "geometry",
            seen + ", and any pixel does within " + in_px(chance_px) +
                " px: the two show different things. Is depth stale, late or mere noise, or the calibration of "
                "other cameras?"};
  if (calibrated_px * square_ > usual_px_ + kBeyondUsual_px)
    return {Finding::Grade::kDoubtful, "geometry",
            seen + "; at most " + fixed(usual_px_, 0) + " px are usual: is this these cameras' calibration?"};
  return {Finding::Grade::kFine, "geometry", seen + "; no mirroring, turning or registration would do better"};
}

}  // namespace sphc::host
