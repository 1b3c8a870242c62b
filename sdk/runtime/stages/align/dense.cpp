#include "runtime/stages/align/dense.h"

#include <hwy/cache_control.h>

#include <cstring>
#include <limits>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr int32_t kRowArrays = 5;  // of a projected row
constexpr double kStretch = 1.05;  // footprints grow on slanted surfaces
constexpr double kMostHalfPx = 255 / static_cast<double>(kFootprintsPerPixel);
constexpr int32_t kShadowReachPx = 48;  // how wide a hole beside an edge may be
constexpr double kObliquest = 0.25;     // gaps open along an axis from this share of the other on
constexpr double kLeastShadowPx = 0.5, kMostShadowPx = 256;

int32_t padded(int32_t count) { return (count + kRowPadding - 1) / kRowPadding * kRowPadding; }

LensF lensF(const Camera &camera) {
  const sphc_camera &parameters = camera.parameters();
  LensF lens = {};
  lens.model = parameters.model;
  lens.fx = static_cast<float>(parameters.params[0]), lens.fy = static_cast<float>(parameters.params[1]);
  lens.cx = static_cast<float>(parameters.params[2] - 0.5),
  lens.cy = static_cast<float>(parameters.params[3] - 0.5);
  for (int i = 0; i < 8; ++i) lens.k[i] = static_cast<float>(parameters.params[4 + i]);
  lens.max_radius2 = static_cast<float>(camera.maxRadius2());
  lens.width = static_cast<float>(camera.width()), lens.height = static_cast<float>(camera.height());
  return lens;
}

// A z-buffer is larger than most caches, and rows to come fall some rows below this one.
void fetchAhead(const uint32_t *index, int32_t count, int32_t stride, const int32_t *pixels) {
  constexpr int32_t kRowsAhead = 4, kEvery = 8;
  for (int32_t i = 0; i < count; i += kEvery) hwy::Prefetch(pixels + index[i] + int64_t{kRowsAhead} * stride);
}

// The nearest sample of each pixel stays.  Four quarters of the row take turns, since neighbours often fall into
// one pixel and would wait for each other.  There is no branch, since no processor foresees which of two is nearer.
void lowerPixels(const ProjectedRow &row, int32_t *__restrict pixels) {
  const uint32_t *__restrict index = row.index;
  const int32_t *__restrict key = row.key;
  const int32_t quarter = row.count / 4;
  const auto lower = [=](int32_t i) {
    int32_t *pixel = pixels + index[i];
    const int32_t before = *pixel, now = key[i];
    *pixel = now < before ? now : before;
  };
  for (int32_t i = 0; i < quarter; ++i) {
    lower(i);
    lower(i + quarter);
    lower(i + 2 * quarter);
    lower(i + 3 * quarter);
  }
  for (int32_t i = 4 * quarter; i < row.count; ++i) lower(i);
}

// Where gaps open: on the sides towards the colour camera.
uint8_t sidesOf(const Vector2 &toward) {
  uint8_t sides = 0;
  if (absOf(toward.x()) > kObliquest * absOf(toward.y())) sides = toward.x() > 0 ? kRightSide : kLeftSide;
  if (absOf(toward.y()) > kObliquest * absOf(toward.x())) sides |= toward.y() > 0 ? kLowerSide : kUpperSide;
  return sides;
}

template <typename T>
void fill(T value, int64_t count, T *to) {
  for (int64_t i = 0; i < count; ++i) to[i] = value;
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
  const size_t ray_pixels = config.depth.isPinhole() ? 0 : depth_pixels;
  a.rays_x_ = arena.take<float>("align.rays", ray_pixels);
  a.rays_y_ = arena.take<float>("align.rays", ray_pixels);
  a.turned_ = arena.take<float>("align.rays", 3 * ray_stride);
  a.half_x_ = arena.take<uint8_t>("align.footprints", depth_pixels);
  a.half_y_ = arena.take<uint8_t>("align.footprints", depth_pixels);
  a.sides_ = arena.take<uint8_t>("align.sides", depth_pixels / kRowPadding);
  a.measured_.keys = arena.take<int32_t>("align.z_buffer", plane);
  a.spread_.keys = arena.take<int32_t>("align.z_buffer", plane);
  a.sensed_ = arena.take<uint16_t>("align.rows", 3 * ray_stride);
  a.slope_ = arena.take<uint16_t>("align.rows", ray_stride);
  a.decoded_depth_ = arena.take<uint16_t>("align.rows", 3 * stride);
  a.decoded_state_ = arena.take<uint16_t>("align.rows", 3 * stride);
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
  const double *k = config.depth.parameters().params;
  per_focal_ = Vector2(1 / k[0], 1 / k[1]);
  center_m_ = config.color_from_depth.inverse().translation_m;
  makeTask();
  makeRays();
  makeFootprints();
  makeSides();
  int32_t *arrays = row_.data();
  int32_t **const of_row[] = {&projected_.key, &projected_.spread_key, &projected_.spread_shape};
  for (int32_t **array : of_row) *array = arrays, arrays += ray_stride_;
  uint32_t **const indices[] = {&projected_.index, &projected_.spread_index};
  for (uint32_t **array : indices) *array = reinterpret_cast<uint32_t *>(arrays), arrays += ray_stride_;
  fill(kEmpty, static_cast<int64_t>(measured_.keys.size()), measured_.keys.data());
  fill(kEmpty, static_cast<int64_t>(spread_.keys.size()), spread_.keys.data());
  for (uint16_t &raw : sensed_) raw = kNotSensed;
  for (uint16_t &depth : decoded_depth_) depth = 0;
  for (uint16_t &state : decoded_state_) state = 0;
}

// From raw measurements to pixels of the colour image and subunits of depth.
void DenseAligner::makeTask() {
  const DenseConfig &c = config_;
  task_ = {};
  task_.color = lensF(c.color);
  Matrix3 lens = Matrix3::Identity();
  const double *k = c.color.parameters().params;
  if (task_.color.model == SPHC_CAMERA_PINHOLE) lens << k[0], 0, k[2] - 0.5, 0, k[1], k[3] - 0.5, 0, 0, 1;
  const double subunits_per_m = kSubUnits / c.out_unit_m;
  const Matrix3 turn = c.sensor.unit_m * subunits_per_m * lens * c.color_from_depth.rotation;
  const Vector3 shift = subunits_per_m * lens * c.color_from_depth.translation_m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) task_.turn[3 * i + j] = static_cast<float>(turn(i, j));
    task_.t[i] = static_cast<float>(shift[i]);
    if (!c.depth.isPinhole()) continue;
    const double *d = c.depth.parameters().params;
    for (int32_t u = 0; u < ray_stride_; ++u)
      turned_[static_cast<size_t>(i * int64_t{ray_stride_} + u)] =
          static_cast<float>(turn(i, 0) * ((u - kRowPadding + 0.5 - d[2]) / d[0]));
  }
  task_.most_subunits = kMostAlignedUnits * kSubUnits;  // an empty pixel reads as much more
  task_.sigma = static_cast<float>(c.sensor.sigma_m / c.sensor.unit_m);
  task_.sigma_per_raw2 = static_cast<float>(c.sensor.sigma_per_m2 * c.sensor.unit_m);
  task_.plane_stride = static_cast<uint32_t>(plane_stride_);
  task_.plane_origin = static_cast<uint32_t>(plane_stride_ + kRowPadding);
  task_.plane_rest = static_cast<uint32_t>((height_ + 1) * plane_stride_);
}

void DenseAligner::makeRays() {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  if (config_.depth.isPinhole()) return;
  for (float &x : rays_x_) x = kNone;
  for (float &y : rays_y_) y = kNone;
  for (int32_t v = 0; v < depth_height_; ++v) {
    for (int32_t u = 0; u < depth_width_; ++u) {
      Vector2 ray;
      if (!config_.depth.unproject({u + 0.5, v + 0.5}, &ray)) continue;
      const size_t at = static_cast<size_t>(v * int64_t{ray_stride_} + kRowPadding + u);
      rays_x_[at] = static_cast<float>(ray.x());
      rays_y_[at] = static_cast<float>(ray.y());
    }
  }
}

void DenseAligner::makeSides() {
  for (uint8_t &sides : sides_) sides = 0;
  for (int32_t v = 0; v < depth_height_; ++v)
    for (int32_t u = 0; u < depth_width_; ++u)
      sides_[static_cast<size_t>(v * int64_t{ray_stride_} + u) / kRowPadding] |= sidesOf(towardColor(rayOf(u, v)));
}

// Half the extent of each depth pixel in the colour image, of far points; spread only if some reach over their
// pixel.
void DenseAligner::makeFootprints() {
  double widest = 0;
  uint8_t narrowest = 255;
  const auto pixelOf = [this](int32_t u, int32_t v, Vector2 *px) {
    Vector2 ray;
    return config_.depth.unproject({u + 0.5, v + 0.5}, &ray) &&
           config_.color.project(config_.color_from_depth.rotation * Vector3(ray.x(), ray.y(), 1), px);
  };
  const auto byteOf = [&](double extent_px) {
    double half = 0.5 * kStretch * extent_px;
    if (!(half < kMostHalfPx)) half = kMostHalfPx;
    if (half > widest) widest = half;
    const uint8_t byte = static_cast<uint8_t>(half * static_cast<double>(kFootprintsPerPixel) + 0.999);
    if (byte < narrowest) narrowest = byte;
    return byte;
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
  task_.grown = static_cast<float>(narrowest) >= kFootprintsPerPixel;
}

void DenseAligner::process(ImageView<uint16_t> depth, const AlignedImages &out) {
  sense(depth, -1);
  sense(depth, 0);
  for (int32_t y = 0; y < depth_height_; ++y) {
    sense(depth, y + 1);
    project(depth, y, out.mask != nullptr);
  }
  decode(-1);
  decode(0);
  for (int32_t y = 0; y < height_; ++y) {
    decode(y + 1);
    resolve(y, out);
  }
}

void DenseAligner::sense(ImageView<uint16_t> depth, int32_t y) {
  uint16_t *row = sensedRow(y);
  if (y >= 0 && y < depth_height_ && low_ <= high_)
    kernels_->sense_row(depth.row(y), low_, high_, depth_width_, row);
  else
    fill(kNotSensed, depth_width_, row);
}

RowToProject DenseAligner::rowToProject(int32_t y) {
  const int64_t start = int64_t{y} * ray_stride_ + kRowPadding;
  RowToProject row = {};
  row.sensed = sensedRow(y), row.slope = slope_.data();
  row.half_x = half_x_.data() + start, row.half_y = half_y_.data() + start;
  row.count = padded(depth_width_);
  float *const turned[] = {turned_.data() + kRowPadding, turned_.data() + ray_stride_ + kRowPadding,
                           turned_.data() + 2 * int64_t{ray_stride_} + kRowPadding};
  for (int i = 0; i < 3; ++i) row.turned[i] = turned[i];
  if (config_.depth.isPinhole()) {
    const double ray_y = rayOf(0, y).y();
    for (int i = 0; i < 3; ++i)
      row.offset[i] = static_cast<float>(static_cast<double>(task_.turn[3 * i + 1]) * ray_y +
                                         static_cast<double>(task_.turn[3 * i + 2]));
  } else {
    kernels_->turn_row(task_.turn, rays_x_.data() + start, rays_y_.data() + start, row.count, turned);
  }
  return row;
}

// Every sample into its pixel, and over its footprint.
void DenseAligner::project(ImageView<uint16_t> depth, int32_t y, bool with_shadows) {
  const RowToProject row = rowToProject(y);
  const SensedRows rows = {sensedRow(y - 1), sensedRow(y), sensedRow(y + 1), row.count,
                           sides_.data() + int64_t{y} * ray_stride_ / kRowPadding};
  const int32_t edge_count = kernels_->compare_row(rows, slope_.data(), with_shadows ? edges_.data() : nullptr);
  kernels_->project_row(task_, row, &projected_);
  fetchAhead(projected_.index, projected_.count, plane_stride_, measured_.keys.data());
  lowerPixels(projected_, measured_.keys.data());
  if (task_.with_footprints) {
    fetchAhead(projected_.spread_index, projected_.count, plane_stride_, spread_.keys.data());
    kernels_->spread_row(projected_, plane_stride_, spread_.keys.data());
  }
  castShadows(depth, y, edges_.data(), edge_count);
}

// x and y of the ray (x, y, 1) of a depth pixel.
Vector2 DenseAligner::rayOf(int32_t x, int32_t y) const {
  if (config_.depth.isPinhole()) {
    const double *k = config_.depth.parameters().params;
    return {(x + 0.5 - k[2]) * per_focal_.x(), (y + 0.5 - k[3]) * per_focal_.y()};
  }
  const size_t at = static_cast<size_t>(y * int64_t{ray_stride_} + kRowPadding + x);
  return {static_cast<double>(rays_x_[at]), static_cast<double>(rays_y_[at])};
}

// The next measurement within `steps` steps, beyond a hole if need be; 0: none.
uint16_t DenseAligner::beside(const uint16_t *pixel, int64_t step, int32_t steps) const {
  const uint32_t range = static_cast<uint32_t>(high_ - low_);
  for (int32_t i = steps < kShadowReachPx ? steps : kShadowReachPx; i > 0; --i) {
    pixel += step;
    const uint32_t above_low = uint32_t{*pixel} - low_;  // wraps around below
    if (above_low <= range) return *pixel;
  }
  return 0;
}

// Marks what near things hide.  `columns`: their last pixels in the row, on the colour camera's side.
void DenseAligner::castShadows(const ImageView<uint16_t> &depth, int32_t y, const int32_t *columns, int32_t count) {
  const uint16_t *row = depth.row(y);
  const double gap_scale = config_.depth.focal() / config_.sensor.unit_m;
  for (int32_t i = 0; i < count; ++i) {
    const int32_t x = columns[i];
    const Vector2 ray = rayOf(x, y), way = towardColor(ray);
    const double reach_x = absOf(way.x()), reach_y = absOf(way.y());
    const uint32_t near = row[x];
    uint32_t far = 0;  // of both sides the farther, where the gap opens that way
    if (reach_x > kObliquest * reach_y)
      far = way.x() > 0 ? beside(row + x, 1, depth.width - 1 - x) : beside(row + x, -1, x);
    if (reach_y > kObliquest * reach_x) {
      const uint32_t down =
          way.y() > 0 ? beside(row + x, depth.stride, depth.height - 1 - y) : beside(row + x, -depth.stride, y);
      if (down > far) far = down;
    }
    if (100 * far <= 103 * near) continue;
    // What the colour camera sees of the gap, in depth pixels: focal * reach * (1 / near - 1 / far).
    const double reach = reach_x > reach_y ? reach_x : reach_y;
    if (gap_scale * reach * (far - near) > kLeastShadowPx * far * near)
      castShadow(ray, static_cast<size_t>(y * int64_t{ray_stride_} + kRowPadding + x), near * config_.sensor.unit_m,
                 far * config_.sensor.unit_m);
  }
}

// Marks the ray of the depth camera behind a sample, from its depth to that of the surface behind.
void DenseAligner::castShadow(const Vector2 &ray, size_t at, double near_m, double far_m) {
  const Vector3 turned = config_.color_from_depth.rotation * Vector3(ray.x(), ray.y(), 1);
  const Vector3 &origin = config_.color_from_depth.translation_m;
  Vector2 near_px, far_px;
  if (!config_.color.project(near_m * turned + origin, &near_px) ||
      !config_.color.project(far_m * turned + origin, &far_px))
    return;
  const Vector2 way = far_px - near_px;
  const double length = absOf(way.x()) > absOf(way.y()) ? absOf(way.x()) : absOf(way.y());
  if (!(length >= kLeastShadowPx && length <= kMostShadowPx)) return;
  const int32_t steps = static_cast<int32_t>(length) + 1;
  const double least = 0.5, per_step = 1.0 / steps;
  const double half_x = half_x_[at] / static_cast<double>(kFootprintsPerPixel);
  const double half_y = half_y_[at] / static_cast<double>(kFootprintsPerPixel);
  const Vector2 half(half_x > least ? half_x : least, half_y > least ? half_y : least);
  for (int32_t i = 0; i <= steps; ++i) markShadow(near_px + way * (i * per_step), half);
}

void DenseAligner::markShadow(const Vector2 &px, const Vector2 &half) {
  constexpr int32_t kFar = 1 << 20;
  if (!(absOf(px.x()) < kFar && absOf(px.y()) < kFar)) return;
  const auto within = [](double edge, int32_t most) {  // the first pixel whose centre is not before the edge
    const int32_t pixel = static_cast<int32_t>(edge + (0.5 + 2 * kFar)) - 2 * kFar;
    return pixel < 0 ? 0 : pixel < most ? pixel : most;
  };
  const int32_t left = within(px.x() - half.x(), width_), right = within(px.x() + half.x(), width_);
  const int32_t top = within(px.y() - half.y(), height_), bottom = within(px.y() + half.y(), height_);
  for (int32_t y = top; y < bottom; ++y) {
    int32_t *row = measured_.row(y, plane_stride_);
    for (int32_t x = left; x < right; ++x)
      if (row[x] == kEmpty) row[x] = kShadowed;  // a sample still to come is less, and so replaces it
  }
}

// Reads a row of the z-buffers and empties it.
void DenseAligner::decode(int32_t y) {
  const DecodedRow row = decodedRow(y);
  if (y >= 0 && y < height_) {
    BufferRow in = {measured_.row(y, plane_stride_), nullptr, nullptr, width_, task_.grown};
    if (task_.with_footprints)
      in.spread = spread_.row(y, plane_stride_), in.spread_above = spread_.row(y - 1, plane_stride_);
    kernels_->decode_row(in, row);
    row.depth[width_] = row.state[width_] = 0;  // samples that fell beside the image
  } else {
    fill(uint16_t{0}, width_, row.depth);
    fill(uint16_t{0}, width_, row.state);
  }
  if (task_.with_footprints && y >= 0)  // row y - 1, from the pixel beside the image on
    fill(kEmpty, width_ + 1, spread_.row(y - 1, plane_stride_) - 1);
}

void DenseAligner::resolve(int32_t y, const AlignedImages &out) {
  const auto from = [](DecodedRow row, int32_t x) { return DecodedRow{row.depth + x, row.state + x}; };
  // Whole vectors go to the caller's rows; the rest, and outputs that the caller left out, to rows of our own.
  const int32_t whole = width_ / kRowPadding * kRowPadding, rest = width_ - whole;
  uint16_t *depth = out.depth ? out.depth + y * out.depth_stride : depth_row_.data();
  uint8_t *mask = out.mask ? out.mask + y * out.mask_stride : mask_row_.data();
  uint8_t *confidence = out.confidence ? out.confidence + y * out.confidence_stride : confidence_row_.data();
  const DecodedRow above = decodedRow(y - 1), here = decodedRow(y), below = decodedRow(y + 1);
  kernels_->resolve_row({above, here, below, whole, depth, mask, confidence});
  if (!rest) return;
  kernels_->resolve_row({from(above, whole), from(here, whole), from(below, whole), kRowPadding, depth_row_.data(),
                         mask_row_.data(), confidence_row_.data()});
  const size_t bytes = static_cast<size_t>(rest);
  if (out.depth) std::memcpy(depth + whole, depth_row_.data(), bytes * sizeof(uint16_t));
  if (out.mask) std::memcpy(mask + whole, mask_row_.data(), bytes);
  if (out.confidence) std::memcpy(confidence + whole, confidence_row_.data(), bytes);
}

}  // namespace sphc
