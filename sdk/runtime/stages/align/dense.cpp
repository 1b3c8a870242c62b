#include "runtime/stages/align/dense.h"

#include <cstring>
#include <limits>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr int32_t kRowArrays = 7;  // of a projected row
constexpr double kStretch = 1.05;  // footprints grow on slanted surfaces
constexpr double kMostHalfPx = 255 / static_cast<double>(kFootprintsPerPixel);
constexpr int32_t kShadowReachPx = 48;  // how wide a hole beside an edge may be
constexpr double kShadowJump = 0.03;    // relative depth step that casts one
constexpr double kFarPx = 1e6;
constexpr double kLeastShadowPx = 0.5, kMostShadowPx = 256;

int32_t padded(int32_t count) { return (count + kRowPadding - 1) / kRowPadding * kRowPadding; }

LensF lensF(const Camera &camera) {
  const sphc_camera &door = camera.parameters();
  LensF lens = {};
  lens.model = door.model;
  lens.fx = static_cast<float>(door.params[0]), lens.fy = static_cast<float>(door.params[1]);
  lens.cx = static_cast<float>(door.params[2]), lens.cy = static_cast<float>(door.params[3]);
  for (int i = 0; i < 8; ++i) lens.k[i] = static_cast<float>(door.params[4 + i]);
  lens.max_radius2 = static_cast<float>(camera.maxRadius2());
  lens.width = static_cast<float>(camera.width()), lens.height = static_cast<float>(camera.height());
  return lens;
}

ProjectTask taskOf(const DenseConfig &config) {
  ProjectTask task = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) task.r[3 * i + j] = static_cast<float>(config.color_from_depth.rotation(i, j));
    task.t[i] = static_cast<float>(config.color_from_depth.translation_m[i]);
    task.center_m[i] = static_cast<float>(config.color_from_depth.inverse().translation_m[i]);
  }
  task.color = lensF(config.color);
  task.subunits_per_m = static_cast<float>(kSubUnits / config.out_unit_m);
  task.most_subunits = 63000.0f * kSubUnits;  // an empty pixel reads as much more
  task.sigma_m = static_cast<float>(config.sensor.sigma_m);
  task.sigma_per_m2 = static_cast<float>(config.sensor.sigma_per_m2);
  task.depth_focal_px = static_cast<float>(config.depth.focal());
  return task;
}

// The nearest sample of each pixel stays.  Four quarters of the row in turn, as neighbours often fall into one
// pixel and would wait for each other; without a branch, as which of two is nearer is not foreseen.
void lowerPixels(const ProjectedRow &row, int32_t count, int32_t *__restrict pixels) {
  const int32_t *__restrict index = row.index;
  const int32_t *__restrict key = row.key;
  const int32_t quarter = padded(count) / 4;
  const auto lower = [=](int32_t u) {
    int32_t *pixel = pixels + index[u];
    const int32_t before = *pixel, now = key[u];
    *pixel = now < before ? now : before;
  };
  for (int32_t u = 0; u < quarter; ++u) {
    lower(u);
    lower(u + quarter);
    lower(u + 2 * quarter);
    lower(u + 3 * quarter);
  }
}

}  // namespace

void DenseAligner::layout(const DenseConfig &config, Arena &arena, DenseAligner *aligner) {
  DenseAligner discarded;
  DenseAligner &a = aligner ? *aligner : discarded;
  a.depth_width_ = config.depth.width(), a.depth_height_ = config.depth.height();
  a.width_ = config.color.width(), a.height_ = config.color.height();
  a.ray_stride_ = padded(a.depth_width_) + 2 * kRowPadding;
  a.plane_stride_ = padded(a.width_) + 2 * kRowPadding;
  const size_t depth_pixels = static_cast<size_t>(a.ray_stride_) * static_cast<size_t>(a.depth_height_);
  const size_t stride = static_cast<size_t>(a.plane_stride_), plane = stride * static_cast<size_t>(a.height_ + 2);
  const size_t ray_stride = static_cast<size_t>(a.ray_stride_);
  a.row_of_rays_ = config.depth.isPinhole() ? 0 : a.ray_stride_;
  a.rays_x_ = arena.take<float>("align.rays", config.depth.isPinhole() ? ray_stride : depth_pixels);
  a.rays_y_ = arena.take<float>("align.rays", config.depth.isPinhole() ? ray_stride : depth_pixels);
  a.half_x_ = arena.take<uint8_t>("align.footprints", depth_pixels);
  a.half_y_ = arena.take<uint8_t>("align.footprints", depth_pixels);
  a.measured_.keys = arena.take<int32_t>("align.z_buffer", plane);
  a.spread_.keys = arena.take<int32_t>("align.z_buffer", plane);
  a.sensed_ = arena.take<float>("align.rows", 3 * ray_stride);
  a.combined_ = arena.take<int32_t>("align.rows", 3 * stride);
  a.row_ = arena.take<int32_t>("align.rows", kRowArrays * ray_stride);
  a.edges_ = arena.take<int32_t>("align.rows", ray_stride);
  a.depth_row_ = arena.take<uint16_t>("align.rows", stride);
  a.mask_row_ = arena.take<uint8_t>("align.rows", stride);
  a.confidence_row_ = arena.take<uint8_t>("align.rows", stride);
}

void DenseAligner::init(const DenseConfig &config, const AlignKernels &kernels) {
  config_ = config;
  kernels_ = &kernels;
  const double low = config.sensor.min_m / config.sensor.unit_m, high = config.sensor.max_m / config.sensor.unit_m;
  low_ = low > 1 ? (low < 65535 ? static_cast<uint16_t>(-floorOf(-low)) : uint16_t{65535}) : uint16_t{1};
  high_ = high < 65535 ? static_cast<uint16_t>(high) : uint16_t{65535};
  task_ = taskOf(config);
  task_.plane_stride = plane_stride_;
  task_.plane_origin = plane_stride_ + kRowPadding;
  makeRays();
  makeFootprints();
  int32_t *arrays = row_.data();
  int32_t **const of_row[kRowArrays] = {&projected_.index, &projected_.key, &projected_.fill_key, &projected_.left,
                                        &projected_.right, &projected_.top, &projected_.bottom};
  for (int32_t i = 0; i < kRowArrays; ++i) *of_row[i] = arrays + i * int64_t{ray_stride_};
  projected_.edges = edges_.data();
}

void DenseAligner::makeRays() {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  for (float &x : rays_x_) x = kNone;
  for (float &y : rays_y_) y = kNone;
  const double *k = config_.depth.parameters().params;
  for (int32_t u = 0; u < depth_width_ && !row_of_rays_; ++u)
    rays_x_[static_cast<size_t>(kRowPadding + u)] = static_cast<float>((u + 0.5 - k[2]) / k[0]);
  for (int32_t v = 0; v < depth_height_ && row_of_rays_; ++v) {
    for (int32_t u = 0; u < depth_width_; ++u) {
      Vector2 ray;
      if (!config_.depth.unproject({u + 0.5, v + 0.5}, &ray)) continue;
      const size_t at = static_cast<size_t>(v * int64_t{row_of_rays_} + kRowPadding + u);
      rays_x_[at] = static_cast<float>(ray.x());
      rays_y_[at] = static_cast<float>(ray.y());
    }
  }
}

// Half the extent of each depth pixel in the colour image, of far points; spread only if some reach over their
// pixel.
void DenseAligner::makeFootprints() {
  double widest = 0;
  const auto pixelOf = [this](int32_t u, int32_t v, Vector2 *px) {
    Vector2 ray;
    return config_.depth.unproject({u + 0.5, v + 0.5}, &ray) &&
           config_.color.project(config_.color_from_depth.rotation * Vector3(ray.x(), ray.y(), 1), px);
  };
  const auto byteOf = [&widest](double extent_px) {
    double half = 0.5 * kStretch * extent_px;
    if (!(half < kMostHalfPx)) half = kMostHalfPx;
    if (half > widest) widest = half;
    return static_cast<uint8_t>(half * static_cast<double>(kFootprintsPerPixel) + 0.999);
  };
  for (uint8_t &half : half_x_) half = 0;
  for (uint8_t &half : half_y_) half = 0;
  for (int32_t v = 0; v < depth_height_; ++v) {
    for (int32_t u = 0; u < depth_width_; ++u) {
      const int32_t beside = u + 1 < depth_width_ ? u + 1 : u - 1, below = v + 1 < depth_height_ ? v + 1 : v - 1;
      Vector2 here, across, down;
      if (!pixelOf(u, v, &here) || !pixelOf(beside, v, &across) || !pixelOf(u, below, &down)) continue;
      const size_t at =
          static_cast<size_t>(v) * static_cast<size_t>(ray_stride_) + kRowPadding + static_cast<size_t>(u);
      half_x_[at] = byteOf(absOf(across.x() - here.x()) + absOf(down.x() - here.x()));
      half_y_[at] = byteOf(absOf(across.y() - here.y()) + absOf(down.y() - here.y()));
    }
  }
  task_.with_footprints = widest > 0.5;
}

void DenseAligner::process(ImageView<uint16_t> depth, const AlignedImages &out) {
  for (int32_t &key : measured_.keys) key = kEmpty;
  if (task_.with_footprints)
    for (int32_t &key : spread_.keys) key = kEmpty;
  for (float &z : sensed_) z = 0;
  sense(depth, 0);
  for (int32_t y = 0; y < depth_height_; ++y) {
    sense(depth, y + 1);
    project(depth, y);
  }
  if (task_.with_footprints)
    for (int32_t &key : combined_) key = kEmpty;
  combine(0);
  for (int32_t y = 0; y < height_; ++y) {
    combine(y + 1);
    resolve(y, out);
  }
}

void DenseAligner::sense(ImageView<uint16_t> depth, int32_t y) {
  float *row = sensedRow(y);
  if (y < depth_height_) {
    kernels_->sense_row(depth.row(y), static_cast<float>(config_.sensor.unit_m), static_cast<float>(low_),
                        static_cast<float>(high_), depth_width_, row);
  } else {
    for (int32_t u = 0; u < depth_width_; ++u) row[u] = 0;
  }
}

// Every sample into its pixel, and over its footprint.
void DenseAligner::project(ImageView<uint16_t> depth, int32_t y) {
  const int64_t start = int64_t{y} * ray_stride_ + kRowPadding;
  if (!row_of_rays_) {
    const double *k = config_.depth.parameters().params;
    const float ray_y = static_cast<float>((y + 0.5 - k[3]) / k[1]);
    for (float &every : rays_y_) every = ray_y;
  }
  const SensedRows rows = {sensedRow(y + 2),       sensedRow(y),        sensedRow(y + 1),
                           rayRow(rays_x_, y),     rayRow(rays_y_, y),  half_x_.data() + start,
                           half_y_.data() + start, padded(depth_width_)};
  kernels_->project_row(task_, rows, &projected_);
  lowerPixels(projected_, depth_width_, measured_.keys.data());
  if (task_.with_footprints)
    kernels_->spread_row(projected_, depth_width_, plane_stride_, spread_.row(0, plane_stride_));
  for (int32_t i = 0; i < projected_.edge_count; ++i) castShadows(depth, projected_.edges[i], y);
}

// The next measurement from pixel (x, y) in a direction, beyond a hole if need be; 0: none.
uint16_t DenseAligner::beside(ImageView<uint16_t> depth, int32_t x, int32_t y, int32_t dx, int32_t dy) const {
  for (int32_t i = 1; i <= kShadowReachPx; ++i) {
    const int32_t u = x + i * dx, v = y + i * dy;
    if (u < 0 || v < 0 || u >= depth.width || v >= depth.height) return 0;
    const uint16_t raw = depth.row(v)[u];
    if (raw >= low_ && raw <= high_) return raw;
  }
  return 0;
}

// From the last pixel of something near, towards the colour camera's side.
void DenseAligner::castShadows(ImageView<uint16_t> depth, int32_t x, int32_t y) {
  const float toward_x = task_.center_m[0] - task_.center_m[2] * rayRow(rays_x_, y)[x];
  const float toward_y = task_.center_m[1] - task_.center_m[2] * rayRow(rays_y_, y)[x];
  // Of both sides the farther, where the gap opens that way.
  uint16_t across = 0, down = 0;
  if (absOf(toward_x) > kObliquest * absOf(toward_y)) across = beside(depth, x, y, toward_x > 0 ? 1 : -1, 0);
  if (absOf(toward_y) > kObliquest * absOf(toward_x)) down = beside(depth, x, y, 0, toward_y > 0 ? 1 : -1);
  const double near_m = depth.row(y)[x] * config_.sensor.unit_m;
  const double far_m = (across > down ? across : down) * config_.sensor.unit_m;
  if (!(far_m > near_m * (1 + kShadowJump))) return;
  const float toward = absOf(toward_x) > absOf(toward_y) ? absOf(toward_x) : absOf(toward_y);
  const double gap_px = config_.depth.focal() * static_cast<double>(toward) * (far_m - near_m) / (far_m * near_m);
  if (gap_px > kLeastShadowPx) castShadow(x, y, near_m, far_m);
}

// What lies behind the sample, from its depth to that of the surface behind, along the ray of the depth camera.
void DenseAligner::castShadow(int32_t x, int32_t y, double near_m, double far_m) {
  const Vector3 ray(static_cast<double>(rayRow(rays_x_, y)[x]), static_cast<double>(rayRow(rays_y_, y)[x]), 1);
  const Vector3 turned = config_.color_from_depth.rotation * ray;
  const Vector3 &origin = config_.color_from_depth.translation_m;
  Vector2 near_px, far_px;
  if (!config_.color.project(near_m * turned + origin, &near_px) ||
      !config_.color.project(far_m * turned + origin, &far_px))
    return;
  const Vector2 way = far_px - near_px;
  const double length = absOf(way.x()) > absOf(way.y()) ? absOf(way.x()) : absOf(way.y());
  if (!(length >= kLeastShadowPx && length <= kMostShadowPx)) return;
  const int32_t steps = static_cast<int32_t>(length) + 1;
  const size_t at = static_cast<size_t>(y * int64_t{ray_stride_} + kRowPadding + x);
  const double least = 0.5;
  const double half_x = half_x_[at] / static_cast<double>(kFootprintsPerPixel);
  const double half_y = half_y_[at] / static_cast<double>(kFootprintsPerPixel);
  for (int32_t i = 0; i <= steps; ++i)
    markShadow(near_px + way * (static_cast<double>(i) / steps), half_x > least ? half_x : least,
               half_y > least ? half_y : least);
}

void DenseAligner::markShadow(const Vector2 &px, double half_x, double half_y) {
  if (!(absOf(px.x()) < kFarPx && absOf(px.y()) < kFarPx)) return;
  const auto from = [](double edge) {
    return edge > 0 ? static_cast<int32_t>(edge) : 0;
  };  // floor of what is inside
  const int32_t left = from(px.x() - half_x + 0.5), right = from(px.x() + half_x + 0.5);
  const int32_t top = from(px.y() - half_y + 0.5), bottom = from(px.y() + half_y + 0.5);
  for (int32_t y = top; y < bottom && y < height_; ++y) {
    int32_t *row = measured_.row(y, plane_stride_);
    for (int32_t x = left; x < right && x < width_; ++x)
      if (row[x] == kEmpty) row[x] = kShadowed;  // a sample still to come is less, and so replaces it
  }
}

void DenseAligner::combine(int32_t y) {
  if (task_.with_footprints && y < height_)
    kernels_->combine_row(measured_.row(y, plane_stride_), spread_.row(y, plane_stride_), width_, combinedRow(y));
  else if (task_.with_footprints)
    for (int32_t x = 0; x < width_; ++x) combinedRow(y)[x] = kEmpty;
}

void DenseAligner::resolve(int32_t y, const AlignedImages &out) {
  const auto rowOf = [this](int32_t at) {
    return task_.with_footprints ? combinedRow(at) : measured_.row(at, plane_stride_);
  };
  ResolvedRow row = {rowOf(y - 1),      rowOf(y),         rowOf(y + 1),          width_,
                     depth_row_.data(), mask_row_.data(), confidence_row_.data()};
  kernels_->resolve_row(row);
  const size_t width = static_cast<size_t>(width_);
  if (out.depth) std::memcpy(out.depth + y * out.depth_stride, row.depth, width * sizeof(uint16_t));
  if (out.mask) std::memcpy(out.mask + y * out.mask_stride, row.mask, width);
  if (out.confidence) std::memcpy(out.confidence + y * out.confidence_stride, row.confidence, width);
}

}  // namespace sphc
