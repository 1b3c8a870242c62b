#include "runtime/localizer/rig_of_frame.h"

namespace sphc {
namespace {

// The way of the camera from the times of other images to that of the colour image.
class WayToColor {
 public:
  WayToColor(int64_t color_time_ns, const Tracker *tracker) : color_time_ns_(color_time_ns), tracker_(tracker) {}

  // Where a sensor stood at the time of the colour image; `between` learns of the way there.  `turn_rad_s` is what
  // is not known of a turn where nothing tells it.
  Rigid place(int64_t time_ns, const Rigid &color_from_sensor, double turn_rad_s, BetweenImages *between) const {
    Way way;
    if (time_ns != color_time_ns_ && !(tracker_ && tracker_->waySince(time_ns, &way))) {
      between->addUnknown(secondsOf(apartNs(color_time_ns_, time_ns)), turn_rad_s);
      return color_from_sensor;
    }
    between->add(way);
    return way.now_from_then * color_from_sensor;
  }

 private:
  int64_t color_time_ns_;
  const Tracker *tracker_;
};

// What is not known of the camera's way from the middle row of an image to its first, or to its last.
Way unknownOfRows(const Camera &camera, double row_time_s, const CameraRate &rate) {
  const double half_s = 0.5 * camera.height() * absOf(row_time_s);
  return {{}, rate.turn_sigma_rad_s * half_s, rate.shift_sigma_m_s * half_s};
}

}  // namespace

RigOfFrame rigOfFrame(const LocalizerConfig &config, const FrameInput &frame, SeenCameras seen,
                      const Tracker *tracker, const CameraRate &rate) {
  RigOfFrame rig;
  BetweenImages unused;  // of an image that is not there
  const WayToColor way(frame.color_time_ns, tracker);
  rig.cameras.color_camera = frame.color_camera.value_or(config.color_camera);
  rig.cameras.color_row_time_s = config.color_row_time_s;
  rig.cameras.motion = rate;
  rig.between.addRows(unknownOfRows(rig.cameras.color_camera, config.color_row_time_s, rate));
  for (size_t i = 0; i < frame.further.size(); ++i) {
    const FurtherView &view = frame.further[i];
    const RigCamera &known = config.further[i];
    rig.cameras.further.push({view.camera.value_or(known.camera),
                              way.place(view.time_ns, view.color_from_camera.value_or(known.color_from_camera),
                                        tuning::kTurnRate, seen & seenBit(i) ? &rig.between : &unused),
                              known.row_time_s});
    if (seen & seenBit(i))
      rig.between.addRows(unknownOfRows(rig.cameras.further[i].camera, known.row_time_s, rate));
  }
  for (size_t i = 0; i < frame.depth.size(); ++i) {
    const DepthView &view = frame.depth[i];
    const RigDepthCamera &known = config.depth[i];
    BetweenImages between;
    const Rigid place = way.place(view.time_ns, view.color_from_depth.value_or(known.color_from_depth),
                                  tuning::kTurnApart, &between);
    rig.cameras.depth.push({view.camera.value_or(known.camera), place});
    if (view.depth.data) rig.between.add(between);
    if (i == 0) rig.between_first_depth = between;
  }
  rig.cameras.teaches = !rig.between.areApart();
  return rig;
}

}  // namespace sphc
