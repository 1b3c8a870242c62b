// Occluding edges of a depth image: where something near hides something far.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

struct DepthEdge {
  // Where the near side ends, or a smooth edge is half way to the far one; centre of the top-left pixel (0.5, 0.5).
  float x_px, y_px;
  uint16_t near;  // the near side's measurement, sensor units
  uint16_t cell;  // of the image, in which it lies
  bool along_y;   // the depth changes down the image, else across it
};

// Edges spread over the image: the first that is met in each cell of a grid, across the image and down it.  What a
// noisy sensor shows between two measurements is none.
class DepthEdges {
 public:
  static constexpr int32_t kColumns = 32, kRows = 24;  // of the grid of cells
  static constexpr size_t kCapacity = size_t{2} * kColumns * kRows;

  static void layout(Arena &scratch, DepthEdges *edges);
  // Reads some lines of the image across and down.
  void find(ImageView<uint16_t> depth, const DepthSensor &sensor);
  Span<const DepthEdge> edges() const { return edges_.first(count_); }

 private:
  struct Measurement;
  struct Walk;
  void findBy(Walk &walk);
  void walk(const Walk &walk);
  void meet(const Walk &walk, const Measurement &before, const Measurement &last, const Measurement &here);
  void keep(const DepthEdge &edge, bool of_two);

  Span<DepthEdge> edges_;
  Span<uint8_t> taken_;            // of each cell: has an edge across, down
  size_t count_ = 0, of_two_ = 0;  // edges; of these with two measurements on each side
};

}  // namespace sphc
