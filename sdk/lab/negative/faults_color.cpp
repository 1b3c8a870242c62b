#include "lab/negative/fault.h"
#include "lab/negative/flip.h"

namespace sphc::host {
namespace {

// Every pixel from elsewhere in the image: `from` takes array coordinates to fractions of the size.
struct Window {
  double x = 0, y = 0, width = 1, height = 1;
};

// The window, cut out and enlarged to the image's size; coordinates beyond the image come in at the other side.
void show(const Window &window, Sequence *s) {
  const uint32_t w = s->colorWidth(), h = s->colorHeight(), c = s->channels();
  for (Shot &shot : s->shots) {
    const std::vector<uint8_t> before = shot.color;
    for (uint32_t y = 0; y < h; ++y)
      for (uint32_t x = 0; x < w; ++x) {
        const auto u = static_cast<uint32_t>(window.x * w + window.width * x + 0.5) % w,
                   v = static_cast<uint32_t>(window.y * h + window.height * y + 0.5) % h;
        for (uint32_t k = 0; k < c; ++k)
          shot.color[(size_t{y} * w + x) * c + k] = before[(size_t{v} * w + u) * c + k];
      }
  }
}

std::function<void(Sequence *)> showing(const Window &window) {
  return [window](Sequence *sequence) { show(window, sequence); };
}

void freezeColor(Sequence *sequence) {
  for (size_t i = 1; i < sequence->shots.size(); ++i) sequence->shots[i].color = sequence->shots[0].color;
}

// The place in a mirror: both images left to right, and the cameras with them.
void mirrorBoth(Sequence *s) {
  for (Shot &shot : s->shots) {
    mirror(s->colorWidth(), s->colorHeight(), s->channels(), &shot.color);
    mirror(s->depthWidth(), s->depthHeight(), 1, &shot.depth);
  }
  sphc_rig &rig = s->rig;
  for (sphc_camera *camera : {&rig.color_camera, &rig.depth_camera})
    camera->params[2] = camera->width - camera->params[2];
  sphc_rigid &pose = rig.color_from_depth;  // x -> -x on both sides
  pose.q_wxyz[2] = -pose.q_wxyz[2];
  pose.q_wxyz[3] = -pose.q_wxyz[3];
  pose.t_m[0] = -pose.t_m[0];
}

}  // namespace

std::vector<SensorFault> colorFaults() {
  const uint32_t disagree = SPHC_FAULT_DEPTH_COLOR_DISAGREE | SPHC_FAULT_FOCAL_DISAGREES;
  const uint32_t frozen = SPHC_FAULT_COLOR_FROZEN | disagree;
  return {{"colour cropped by 10 %", showing({0.1, 0.1, 0.8, 0.8}), disagree, false, false},
          {"colour rolled by a sixteenth", showing({0.0625, 0, 1, 1}), disagree, false, false},
          {"colour scaled to 80 % of its width", showing({0.1, 0, 0.8, 1}), disagree, false, false},
          {"colour frozen", freezeColor, frozen, false, false},
          {"mirrored views", mirrorBoth, SPHC_FAULT_MIRRORED, false, true}};
}

}  // namespace sphc::host
