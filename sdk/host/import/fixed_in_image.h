// What is fixed in the image, and goes along with the camera: text and menus that are drawn over it, the rim of a
// visor, dirt on the lens.  Depth does not tell, for it measures the room behind.  A frame that shows the same
// agrees with all frames of the map that do, wherever its camera is.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "host/import/point_tracks.h"

namespace sphc::host {

class FixedInImage {
 public:
  // The frames that follow are of this camera.
  void begin(const Camera &camera);
  // Frame after frame.  What looks alike at one pixel is one spot: sets Observation::spot.
  void add(const Rigid &camera_from_world, std::vector<Observation> *observations);
  // After all: drops the points that were mostly seen at spots which stayed in the image while the camera moved,
  // again and again, or beside such spots.  Returns how many.
  uint32_t dropFrom(std::vector<TrackedPoint> *points) const;

 private:
  // One that the last frames saw.
  struct RecentSpot {
    uint32_t number, last_frame;
    Vector2 image_px;
    Vector3 position_m;  // in the world, as when the camera last moved
    Descriptor descriptor;
  };
  struct Spot {
    size_t cell;  // of all images
    uint32_t seen;
    uint32_t moves;  // of the camera, while the spot stayed
  };
  size_t cellOf(const Vector2 &pixel_px) const;
  std::array<size_t, 9> around(size_t cell) const;
  RecentSpot *find(size_t cell, const Observation &seen);
  void addSpot(size_t cell, Observation *seen);
  std::vector<bool> fixedCells() const;
  bool isSeenElsewhere(const Rigid &camera_from_world, const RecentSpot &spot) const;

  Camera camera_;
  size_t across_ = 0, first_cell_ = 0;           // of its image
  std::vector<std::vector<RecentSpot>> recent_;  // of each of its cells
  std::vector<Spot> spots_;
  uint32_t frame_ = 0;
};

}  // namespace sphc::host
