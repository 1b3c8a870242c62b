// headset.h - the room, the walk and the two cameras together; what an open handle holds.  Immutable once made, so
// any number of threads may ask it for images.
#pragma once

#include "drivers/simulated/cameras.h"
#include "drivers/simulated/lens.h"
#include "drivers/simulated/scene.h"
#include "drivers/simulated/simulated.h"
#include "drivers/simulated/walk.h"

namespace sphc::simulated {

class Raster;
struct Poses;

// A camera at one moment.
struct View {
  const sphc_camera &camera;
  const RayTable &rays;
  float vignetting;
  int64_t time_ns;
  uint64_t seed;  // of its noise
};

class Headset {
 public:
  // The config must have passed checkConfig.
  explicit Headset(const sphc_simulated_config &config);

  const sphc_simulated_config &config() const { return config_; }
  const sphc_rig &rig() const { return cameras_.rig; }
  int64_t colorTime(uint32_t index) const;
  int64_t depthTime(uint32_t index) const { return colorTime(index) + config_.depth_delay_ns; }
  // Seconds after the begin of the walk.
  double walkTime(int64_t time_ns) const {
    return static_cast<double>(time_ns - config_.start_time_ns) * 1e-9 + config_.walk_start_s;
  }
  Pose colorPose(int64_t time_ns) const { return colorPoseAfter(time_ns, 0); }
  // In the axes of the colour camera, m/s^2.
  Vec3d felt(int64_t time_ns) const;

  void renderColor(uint32_t index, uint8_t *rgb) const;
  void renderDepth(uint32_t index, uint16_t *depth) const;
  void renderAmplitude(uint32_t index, uint16_t *amplitude) const;
  // Of a camera that the headset does not have: still, and anywhere.
  void renderView(const sphc_camera &camera, const Pose &pose, int64_t time_ns, uint8_t *rgb) const;
  void renderViewDepth(const sphc_camera &camera, const Pose &pose, int64_t time_ns, uint16_t *depth) const;
  void oracleView(const sphc_camera &camera, const Pose &pose, int64_t time_ns, float *depth_m) const;

  void oracleColor(int64_t time_ns, float *depth_m) const;
  void oracleDepth(int64_t time_ns, float *depth_m) const;

 private:
  struct Light {
    float r = 0, g = 0, b = 0;
  };
  // Of an exposure, cut into `count` parts of equal length.
  struct Part {
    uint32_t index, count;
  };

  // Adds the light of one part of an exposure, to one sum a pixel.
  void gatherLight(const View &view, const Raster &raster, std::vector<Light> *lights) const;
  // The same of an image whose rows are exposed one after another.
  void gatherRowByRow(const View &view, const Part &part, std::vector<Light> *lights) const;
  // The same of the rows from `top` to before `bottom`.
  void gatherRows(const View &view, const Raster &raster, uint32_t top, uint32_t bottom,
                  std::vector<Light> *lights) const;
  // Of so many parts.
  void developAll(const View &view, const std::vector<Light> &lights, uint32_t parts, uint8_t *rgb) const;
  // The pose `offset_s` after a time: fractions of an exposure are finer than the clock.
  Pose colorPoseAfter(int64_t time_ns, double offset_s) const;
  Pose depthPose(int64_t time_ns) const;
  // The solids, where they are at a time.
  std::vector<Shape> shapesAt(int64_t time_ns) const;
  const sphc_camera &colorCamera() const { return cameras_.rig.color_camera; }
  const sphc_camera &depthCamera() const { return cameras_.rig.depth_camera; }
  void renderIdealDepth(uint32_t index, uint16_t *depth) const;
  View depthView(uint32_t index) const;
  // At the four moments of a part of the exposure about a time.
  Poses posesDuring(const Part &part, int64_t time_ns) const;
  double exposure_s() const { return config_.exposure_s * static_cast<double>(scene_.lighting.exposure_time); }
  // Calls visit(pixel, echo, ray) for all pixels, from several threads.
  template <typename Visit>
  void forEchoes(const View &view, const Pose &pose, const Visit &visit) const;
  void measureDepth(const View &view, const Pose &pose, uint16_t *depth) const;
  uint64_t noiseSeed(uint32_t index, uint64_t stream) const;
  uint64_t noiseSeed(const Pose &pose, int64_t time_ns, uint64_t stream) const;

  sphc_simulated_config config_;
  Cameras cameras_;
  RayTable color_rays_, depth_rays_;
  Scene scene_;
  Walk walk_;
};

}  // namespace sphc::simulated
