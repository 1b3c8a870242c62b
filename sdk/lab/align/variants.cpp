#include <time.h>

#include <stdexcept>

#include "lab/align/variant.h"
#include "runtime/base/random.h"
#include "runtime/stages/align/sparse.h"
#include "spherecloud/spherecloud.hpp"

namespace sphc::host {
namespace {

constexpr double kNearM = 0.25, kFarM = 6;

AlignFunction makeOurs(const AlignCase &c) {
  sphc_aligner_config config = spherecloud::defaultAlignerConfig();
  config.rig = c.rig;
  auto aligner = std::make_shared<spherecloud::Aligner>();
  const spherecloud::Status status = spherecloud::Aligner::make(config, aligner.get());
  if (status.failed()) throw std::runtime_error(status.text());
  auto confidence = std::make_shared<std::vector<uint8_t>>(size_t{c.color().width} * c.color().height);
  return [aligner, confidence, c](const AlignFrame &frame, AlignedFrame *out) {
    out->depth.resize(confidence->size());
    out->mask.resize(confidence->size());
    const sphc_image depth =
        spherecloud::image(frame.depth.data(), c.depth().width, c.depth().height, SPHC_FORMAT_DEPTH16);
    const sphc_aligned aligned =
        spherecloud::aligned(c.color().width, out->depth.data(), out->mask.data(), confidence->data());
    const double begin = threadSeconds();
    const spherecloud::Status done = aligner->process(depth, aligned);
    out->seconds = threadSeconds() - begin;
    if (done.failed()) throw std::runtime_error(done.text());
  };
}

// As one writes it at first: each depth pixel to its point, to the nearest colour pixel, the nearer stays.
AlignFunction makeLoop(const AlignCase &c) {
  struct Loop {
    Camera color, depth;
    Rigid color_from_depth;
    std::vector<Vector2> rays;
  };
  auto loop =
      std::make_shared<Loop>(Loop{Camera(c.color()), Camera(c.depth()), rigidFromC(c.rig.color_from_depth), {}});
  for (uint32_t y = 0; y < c.depth().height; ++y) {
    for (uint32_t x = 0; x < c.depth().width; ++x) {
      Vector2 ray(0, 0);
      loop->depth.unproject({x + 0.5, y + 0.5}, &ray);
      loop->rays.push_back(ray);
    }
  }
  return [loop, c](const AlignFrame &frame, AlignedFrame *out) {
    out->depth.resize(size_t{c.color().width} * c.color().height);
    const double begin = threadSeconds();
    std::fill(out->depth.begin(), out->depth.end(), uint16_t{0});
    for (size_t i = 0; i < frame.depth.size(); ++i) {
      const double z = frame.depth[i] * c.rig.depth_unit_m;
      if (z < kNearM || z > kFarM) continue;
      const Vector3 point = loop->color_from_depth * Vector3(z * loop->rays[i].x(), z * loop->rays[i].y(), z);
      Vector2 px;
      if (!loop->color.project(point, &px) || px.x() < 0 || px.y() < 0 || px.x() >= c.color().width ||
          px.y() >= c.color().height)
        continue;
      uint16_t &pixel = out->depth[static_cast<size_t>(px.y()) * c.color().width + static_cast<size_t>(px.x())];
      const uint16_t now = static_cast<uint16_t>(point.z() / c.rig.depth_unit_m + 0.5);
      if (pixel == 0 || now < pixel) pixel = now;
    }
    out->seconds = threadSeconds() - begin;
  };
}

}  // namespace

const char kAlignOurs[] = "ours", kAlignLoop[] = "plain loop";

double threadSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

AlignVariant ourAligner() { return {kAlignOurs, makeOurs, ""}; }
AlignVariant plainLoop() { return {kAlignLoop, makeLoop, ""}; }

std::function<SparseTime(const AlignFrame &)> sparseLift(const AlignCase &c, uint32_t keypoints) {
  struct Lifting {
    spherecloud::AlignedBuffer memory;
    SparseAligner aligner;
    std::vector<Vector2> pixels;
  };
  auto lifting = std::make_shared<Lifting>();
  const int32_t width = static_cast<int32_t>(c.depth().width), height = static_cast<int32_t>(c.depth().height);
  Arena measure;
  SparseAligner::layout(width, height, measure, nullptr);
  lifting->memory = spherecloud::AlignedBuffer(measure.used(), kArenaAlignment);
  Arena arena(lifting->memory.data());
  SparseAligner::layout(width, height, arena, &lifting->aligner);
  lifting->aligner.init({c.rig.depth_unit_m, kNearM, kFarM, 0.004, 0.002});
  lifting->aligner.setCameras(Camera(c.color()), Camera(c.depth()), rigidFromC(c.rig.color_from_depth));
  Random random(1);
  for (uint32_t i = 0; i < keypoints; ++i)
    lifting->pixels.emplace_back(0.01 * random.below(100 * c.color().width),
                                 0.01 * random.below(100 * c.color().height));
  return [lifting, width, height](const AlignFrame &frame) {
    const ImageView<uint16_t> view = {frame.depth.data(), width, height, width};
    SparseTime time;
    const double begin = threadSeconds();
    lifting->aligner.prepare(view);
    for (const Vector2 &pixel : lifting->pixels) {
      Vector3 point_m;
      double sigma_m = 0;
      time.lifted += lifting->aligner.lift(view, pixel, &point_m, &sigma_m);
    }
    time.seconds = threadSeconds() - begin;
    return time;
  };
}

}  // namespace sphc::host
