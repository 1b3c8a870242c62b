// Does depth lie on the image as the calibration says?  Edges of depth should be edges of the image: they are
// compared as calibrated, under the usual mistakes, and with any pixel, which tells what chance does.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "host/live/depth_edge_points.h"
#include "host/live/finding.h"
#include "host/recording/calibration.h"

namespace sphc::host {

class GeometryCheck {
 public:
  explicit GeometryCheck(const sphc_rig &calibration);

  // A pair of images of the calibration's sizes.
  void look(const sphc_image &color, const sphc_image &depth);
  Finding finding() const;

 private:
  enum Mistake { kNone, kMirrored, kUpsideDown, kTurned, kRegistered, kInverse, kMistakes };

  bool canBe(Mistake mistake) const;
  sphc_rig calibrationOf(Mistake mistake) const;
  std::optional<Finding> nothingToTell() const;
  bool missesTheImage() const;
  std::vector<uint16_t> aligned(const sphc_image &depth) const;
  struct Pixel {
    uint32_t x, y;
  };
  std::optional<Pixel> projected(const DepthEdgePoint &edge, Mistake mistake, const sphc_rig &rig) const;

  sphc_rig calibration_;
  uint32_t square_;       // pixels of colour across one that is compared
  sphc_camera compared_;  // the colour camera of such squares
  double usual_px_;       // of colour
  std::array<std::vector<double>, kMistakes> distances_px_;
  std::vector<double> chance_px_;  // of any pixel
  size_t image_edges_ = 0;
  size_t measured_ = 0, in_depth_ = 0;  // pixels of depth images that have depth, and all
  size_t reached_ = 0, in_image_ = 0;   // pixels of images that have depth as calibrated, and all
};

}  // namespace sphc::host
