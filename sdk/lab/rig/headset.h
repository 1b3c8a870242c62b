// A headset of four grey cameras and a wide ToF camera, or narrow ones, in the simulated room.
#pragma once
#include <memory>
#include <spherecloud/spherecloud.hpp>
#include <vector>

#include "drivers/simulated/simulated.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {

struct SimulatedCloser {
  void operator()(sphc_simulated *simulated) const { sphc_simulated_close(&simulated); }
};
using Simulated = std::unique_ptr<sphc_simulated, SimulatedCloser>;

// What measures depth: one camera that sees nearly all, a narrow one ahead, or that and one to the left, which says
// 1 cm more than is true.
enum class RigTof { kWide, kAhead, kAheadAndLeft };

struct RigSetup {
  uint32_t cameras = 1;  // the first of them
  RigTof tof = RigTof::kWide;
};

// The images of all cameras at one moment.
struct RigShot {
  std::vector<std::vector<uint8_t>> gray;  // of each camera, the first ahead
  std::vector<uint16_t> wide, ahead, left;
};

// What a config or a frame borrows.
struct RigArrays {
  std::vector<sphc_localizer_camera> cameras;
  std::vector<sphc_localizer_view> views;
  sphc_localizer_depth_camera depth_camera;
  sphc_localizer_depth_view depth_view;
};

class RigHeadset {
 public:
  static constexpr uint32_t kCameras = 4;  // one ahead, one to the left, one to the right, one down

  // Borrows the room.
  explicit RigHeadset(const sphc_simulated *room) : room_(room) {}

  static void setCameras(const RigSetup &setup, RigArrays *arrays, sphc_localizer_config *config);

  RigShot look(const Rigid &world_from_camera, int64_t time_ns) const;
  static sphc_localizer_frame frameOf(const RigShot &shot, int64_t time_ns, const RigSetup &setup,
                                      RigArrays *arrays);

  // Where the headset looks level in a direction.  False where the first camera sees more than a wall there.
  bool faceWall(const Vector3 &centre_m, double heading_rad, int64_t time_ns, Rigid *facing) const;

 private:
  const sphc_simulated *room_;
};

}  // namespace sphc::host
