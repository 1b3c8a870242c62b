// Depth of single colour pixels, from a depth image of another camera.
//
//     SparseAligner::layout(width, height, scratch, &aligner);   as every module's
//     aligner.init(sensor);                                      once
//     aligner.setCameras(color, depth, color_from_depth);        once, or whenever they change
//     aligner.prepare(image);                                    once a frame
//     aligner.lift(image, pixel, ...);                           for every keypoint
//
// Without memory from layout, prepare does nothing and lift gives the same answers, only slower.
#pragma once
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/stages/align/depth_blocks.h"
#include "runtime/stages/align/depth_patch.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

class SparseAligner {
 public:
  SparseAligner() = default;
  // Without memory.
  SparseAligner(const Camera &color, const Camera &depth, const Rigid &color_from_depth,
                const DepthSensor &sensor) {
    init(sensor);
    setCameras(color, depth, color_from_depth);
  }

  // For depth images of this size; `aligner` is null while measuring.
  static void layout(int32_t depth_width, int32_t depth_height, Arena &scratch, SparseAligner *aligner) {
    DepthBlocks::layout(depth_width, depth_height, scratch, aligner ? &aligner->blocks_ : nullptr);
  }
  void init(const DepthSensor &sensor) { sensor_ = sensor; }
  // For the frames that follow.
  void setCameras(const Camera &color, const Camera &depth, const Rigid &color_from_depth);
  // Reads a depth image, so that rays can be followed in strides.  Call it for every new image, before lift.
  // `for_others`: even where this colour camera shares the depth image's pixels.
  void prepare(ImageView<uint16_t> depth, bool for_others = false);
  // In its place, where another aligner of the same depth camera has read the image, for others too; in that one's
  // memory.
  void prepareLike(const SparseAligner &other) { blocks_ = other.blocks_; }

  // Point seen at a colour pixel, in the colour camera's frame, and 1 sigma of its z; false where the depth camera
  // has no answer: a hole, out of its view, or hidden from it behind something nearer.
  bool lift(ImageView<uint16_t> depth, const Vector2 &color_pixel_px, Vector3 *point_m, double *sigma_m) const;
  const Camera &color() const { return color_; }
  // Colour pixel of a point in the colour camera's frame; false where it has none.
  bool project(const Vector3 &point_m, Vector2 *pixel_px) const { return color_.project(point_m, pixel_px); }
  // Unit bearing of a colour pixel; false where the camera's distortion has none.
  bool bearing(const Vector2 &color_pixel_px, Vector3 *bearing) const;

 private:
  struct Walk;
  bool findSurface(ImageView<uint16_t> depth, const Vector2 &ray, Vector2 *depth_pixel_px) const;
  int first(const Walk &walk) const;
  int next(const Walk &walk, int step, const Vector2 &pixel_px) const;
  double stepOfDepth(const Walk &walk, uint16_t nearest, double never) const;

  Camera color_, depth_;
  Rigid depth_from_color_;
  DepthSensor sensor_ = {};
  bool registered_ = false;  // the two images share one pixel grid
  DepthBlocks blocks_;
};

}  // namespace sphc
