// A headset of four grey cameras and a wide ToF camera, in the simulated room.
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

// The images of all cameras at one moment.
struct RigShot {
  std::vector<std::vector<uint8_t>> gray;  // of each camera, the first ahead
  std::vector<uint16_t> depth;
};

class RigHeadset {
 public:
  static constexpr uint32_t kCameras = 4;  // one ahead, one to the left, one to the right, one down

  // Borrows the room.
  explicit RigHeadset(const sphc_simulated *room) : room_(room) {}

  // The first `cameras` of them and the ToF camera, with `further` as memory for the config's cameras.
  static void setCameras(uint32_t cameras, std::vector<sphc_localizer_camera> *further,
                         sphc_localizer_config *config);

  RigShot look(const Rigid &world_from_camera, int64_t time_ns) const;
  // Of a shot, for the first `cameras`; `views` is memory for the frame's.
  static sphc_localizer_frame frameOf(const RigShot &shot, int64_t time_ns, uint32_t cameras,
                                      std::vector<sphc_localizer_view> *views);

  // Where the headset looks level in a direction.  False where the first camera sees more than a wall there.
  bool faceWall(const Vector3 &centre_m, double heading_rad, int64_t time_ns, Rigid *facing) const;

 private:
  const sphc_simulated *room_;
};

}  // namespace sphc::host
