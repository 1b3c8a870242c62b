#include <algorithm>
#include <cmath>
#include <iterator>

#include "tests/fuzz/arguments.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

constexpr uint32_t kMaps = 3, kViewpoints = 3, kMostCalls = 40;
constexpr uint32_t kKeypoints = 128;  // its cameras share them

// A second camera, turned a little, of images as large as the first one's.
const sphc_localizer_camera &sideCamera() {
  static const sphc_localizer_camera camera = [] {
    sphc_localizer_camera made;
    sphc_localizer_camera_init(&made, sizeof made);
    made.camera = smallConfig().rig.color_camera;
    made.color_from_camera = {{0.995, 0, 0.0998749, 0}, {0.06, 0, 0.01}};
    made.row_time_ns = 20000;
    return made;
  }();
  return camera;
}

// A second depth camera, as large as the first one.
const sphc_localizer_depth_camera &secondDepthCamera() {
  static const sphc_localizer_depth_camera camera = [] {
    sphc_localizer_depth_camera made;
    sphc_localizer_depth_camera_init(&made, sizeof made);
    made.camera = smallConfig().rig.depth_camera;
    made.color_from_depth = {{0.995, 0, -0.0998749, 0}, {-0.04, 0, 0.01}};
    return made;
  }();
  return camera;
}

// The order of a caller's threads is anybody's guess.
void runBackwards(void *, uint32_t count, sphc_task_fn task, void *task_data) {
  for (uint32_t i = count; i > 0; --i) task(task_data, i - 1);
}

sphc_localizer_config trackingConfig() {
  sphc_localizer_config config = smallConfig();
  config.max_keypoints = kKeypoints;
  config.cameras = &sideCamera();
  config.camera_count = 1;
  config.depth_cameras = &secondDepthCamera();
  config.depth_camera_count = 1;
  config.color_row_time_ns = 50000;
  config.mode = SPHC_MODE_TRACKING;
  config.max_maps = kMaps - 1;  // so that it can be full
  config.depth_offset_sigma_m = 0.01;
  config.depth_slope_sigma = 0.01;
  config.parallel = runBackwards;
  config.parallel_tasks = 3;
  return config;
}

bool isFinite(const double *values, size_t count) {
  for (size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

// Maps and frames, made once.
struct SessionMaterial {
  test::Session rooms{smallConfig(), 0.7, kMaps};
  std::vector<std::unique_ptr<test::SceneFrame>> frames;

  SessionMaterial() {
    for (uint32_t i = 0; i < kViewpoints; ++i) frames.push_back(test::sceneFrame(smallConfig(), i));
  }
};

// One localizer from its first call to its last.
class Play {
 public:
  Play(SessionMaterial *material, Reader *reader) : material_(*material), reader_(*reader) {
    const sphc_localizer_config config = trackingConfig();
    sphc_memory need = {};
    sphc_localizer_memory(&config, &need, nullptr);
    state_ = test::GuardedMemory(need.state_bytes, need.alignment);
    scratch_ = test::GuardedMemory(need.scratch_bytes, need.alignment);
    if (sphc_localizer_init(state_.data(), state_.size(), scratch_.data(), scratch_.size(), &config, &localizer_,
                            nullptr) != SPHC_OK)
      broken("what can be measured can be made");
    sphc_localizer_result_init(&result_, sizeof result_);
    sphc_features_memory(&config, &need, nullptr);
    features_memory_ = test::GuardedMemory(need.state_bytes, need.alignment);
    if (sphc_features_init(features_memory_.data(), features_memory_.size(), &config, &features_, nullptr) !=
        SPHC_OK)
      broken("what can be measured can be made");
    sphc_localizer_set_parameter(localizer_, SPHC_PARAMETER_MAX_ITERATIONS, 100);
  }
  ~Play() {
    sphc_localizer_fini(&localizer_);
    sphc_features_fini(&features_);
  }
  Play(const Play &) = delete;
  Play &operator=(const Play &) = delete;

  void call() {
    using Call = void (Play::*)();
    constexpr Call kCalls[] = {
        &Play::process,         &Play::processInHalves, &Play::setMap,       &Play::setMap,       &Play::removeMap,
        &Play::setMapTransform, &Play::predict,         &Play::setParameter, &Play::setDepthBias, &Play::observe,
        &Play::askConfidence,   &Play::convertCamera,   &Play::convertMap,   &Play::setFeatures,  &Play::rank};
    const uint32_t which = reader_.next() % (std::size(kCalls) + 1);
    if (which == std::size(kCalls)) return sphc_localizer_reset(localizer_);
    (this->*kCalls[which])();
    if (!state_.guardsIntact() || !scratch_.guardsIntact() || !features_memory_.guardsIntact())
      broken("localizer and features keep inside their memory");
  }

 private:
  void explains(sphc_status status) const {
    if (status > SPHC_OK && status != SPHC_NOT_LOCALIZED) broken("a status is one of those that are stated");
    if (status < 0 && !sphc_localizer_message(localizer_)[0]) broken("a refusal explains itself");
  }

  sphc_localizer_frame anyFrame() {
    sphc_localizer_frame frame = material_.frames[reader_.next() % kViewpoints]->frame;
    frame.color_time_ns = time_ns_ += int64_t{1000000} * reader_.next();
    frame.depth_time_ns = frame.color_time_ns + around(0, &reader_);
    fillView();
    frame.views = &view_.its;
    frame.view_count = around(1, &reader_);
    fillDepthView();
    frame.depth_views = &depth_view_.its;
    frame.depth_view_count = around(1, &reader_);
    if (reader_.next() < 100) {
      prior_.its = priorFrom(&reader_);
      frame.prior = &prior_.its;
    }
    return frame;
  }
  void fillView() {
    sphc_localizer_view &view = view_.its;
    view = {};
    view.struct_size = around(sizeof view, &reader_);
    view.time_ns = time_ns_ + around(0, &reader_);
    view.image = material_.frames[reader_.next() % kViewpoints]->frame.color;
    view.image.width = around(view.image.width, &reader_);
    if (reader_.next() < 50) view.image.data = nullptr;
    if (reader_.next() < 50) {
      camera_ = sideCamera().camera;
      camera_.params[reader_.next() % 12] = anyNumber(&reader_);
      view.camera = &camera_;
    }
    if (reader_.next() < 50) {
      fill(&mount_, &reader_);
      view.color_from_camera = &mount_;
    }
  }
  void fillDepthView() {
    sphc_localizer_depth_view &view = depth_view_.its;
    view = {};
    view.struct_size = around(sizeof view, &reader_);
    view.time_ns = time_ns_ + around(0, &reader_);
    view.depth = material_.frames[reader_.next() % kViewpoints]->frame.depth;
    view.depth.width = around(view.depth.width, &reader_);
    if (reader_.next() < 50) view.depth.data = nullptr;
    if (reader_.next() < 50) {
      depth_camera_ = secondDepthCamera().camera;
      depth_camera_.params[reader_.next() % 12] = anyNumber(&reader_);
      view.camera = &depth_camera_;
    }
  }
  void isAnswered(sphc_status status) const {
    explains(status);
    if (status >= 0 && !isFilled(result_)) broken("a result has finite numbers");
  }
  void process() {
    const sphc_localizer_frame frame = anyFrame();
    const sphc_status status = sphc_localizer_process(localizer_, &frame, &result_);
    isAnswered(status);
    if (status == SPHC_OK) accept();
  }
  void processInHalves() {
    const sphc_localizer_frame frame = anyFrame();
    if (reader_.next() < 200 && sphc_localizer_extract(localizer_, &frame, features_) < 0 &&
        !sphc_features_message(features_)[0])
      broken("a refusal explains itself");
    isAnswered(sphc_localizer_locate(localizer_, &frame, features_, &result_));
  }
  // What came out goes in again, changed at times.
  void setFeatures() {
    sphc_features_arrays arrays = {};
    arrays.struct_size = sizeof arrays;
    if (sphc_features_get(features_, &arrays) != SPHC_OK) return;
    std::vector<sphc_keypoint> keypoints(arrays.keypoints, arrays.keypoints + arrays.count);
    const std::vector<uint8_t> descriptors(arrays.descriptors,
                                           arrays.descriptors + size_t{arrays.count} * SPHC_DESCRIPTOR_BYTES);
    if (!keypoints.empty() && reader_.next() < 128) {
      sphc_keypoint &one = keypoints[reader_.next() % keypoints.size()];
      for (float *value : {&one.x_px, &one.y_px, &one.scale_px, &one.angle_rad, &one.response})
        if (reader_.next() < 100) *value = static_cast<float>(anyNumber(&reader_));
    }
    arrays.count = static_cast<uint32_t>(keypoints.size()) - (keypoints.empty() ? 0 : reader_.next() % 2);
    arrays.extractor = around(arrays.extractor, &reader_);
    arrays.keypoints = keypoints.data();
    arrays.descriptors = descriptors.data();
    const sphc_localizer_frame frame = anyFrame();
    const sphc_status status = sphc_features_set(features_, &frame, &arrays);
    if (status < 0 && !sphc_features_message(features_)[0]) broken("a refusal explains itself");
  }
  void setMap() {
    const uint32_t id = anyId(), room = reader_.next() % kMaps;
    explains(sphc_localizer_set_map(localizer_, id, material_.rooms.map(room)));
    if (sphc_localizer_map_count(localizer_) > kMaps - 1) broken("no more maps than there is room for");
  }
  void removeMap() { explains(sphc_localizer_remove_map(localizer_, anyId())); }
  void setMapTransform() {
    const uint32_t id = anyId();
    sphc_rigid pose = {};
    fill(&pose, &reader_);
    const double rotation_sigma_rad = anyNumber(&reader_), translation_sigma_m = anyNumber(&reader_);
    explains(sphc_localizer_set_map_transform(localizer_, id, reader_.next() < 40 ? nullptr : &pose,
                                              rotation_sigma_rad, translation_sigma_m));
  }
  void predict() {
    sphc_localizer_prediction prediction;
    sphc_localizer_prediction_init(&prediction, sizeof prediction);
    const int64_t at_ns = reader_.next() < 200 ? time_ns_ + int64_t{4000000} * (reader_.next() - 64)
                                               : static_cast<int64_t>(uint64_t{reader_.take32()} << 32);
    if (sphc_localizer_predict(localizer_, at_ns, &prediction) < 0) broken("a prediction of any time is answered");
    if (!isFinite(prediction.camera_from_map.t_m, 3) || !isFinite(prediction.covariance, 36) ||
        !isFinite(prediction.velocity_in_map_m_s, 3))
      broken("a prediction has finite numbers");
  }
  void setParameter() {
    const auto parameter = static_cast<sphc_localizer_parameter>(around(1 + reader_.next() % 4, &reader_));
    const double value = reader_.next() < 128 ? anyNumber(&reader_) : reader_.next();
    const sphc_status status = sphc_localizer_set_parameter(localizer_, parameter, value);
    explains(status);
    double now = 0;
    if (status == SPHC_OK && (sphc_localizer_get_parameter(localizer_, parameter, &now) != SPHC_OK || now != value))
      broken("a parameter is what it was set to");
  }
  void setDepthBias() {
    sphc_depth_bias bias = result_.depth;
    if (reader_.next() < 128)
      for (double *value : {&bias.mid_m, &bias.offset_m, &bias.slope, &bias.offset_sigma_m, &bias.slope_sigma,
                            &bias.correlation, &bias.noise_scale})
        if (reader_.next() < 80) *value = anyNumber(&reader_);
    explains(sphc_localizer_set_depth_bias(localizer_, &bias));
  }
  void observe() {
    alignas(sphc_localizer_observation) uint8_t room[80 * 256];
    uint32_t count = 0;
    const uint32_t stride_bytes = around(sizeof(sphc_localizer_observation), &reader_);
    const uint32_t capacity = std::min<uint32_t>(reader_.next(), sizeof room / std::max(stride_bytes, 1u));
    sphc_localizer_observations(localizer_, reinterpret_cast<sphc_localizer_observation *>(room), stride_bytes,
                                capacity, &count);
    if (count > kKeypoints) broken("no more observations than keypoints");
  }
  void rank() {
    sphc_localizer_hypothesis list[SPHC_HYPOTHESES_MAX];
    uint32_t count = 0;
    sphc_localizer_hypotheses(localizer_, list, sizeof list[0], SPHC_HYPOTHESES_MAX, &count);
    if (count > SPHC_HYPOTHESES_MAX) broken("no more hypotheses than are stated");
    for (uint32_t i = 0; i < count; ++i)
      if (!isFinite(list[i].camera_from_map.t_m, 3) || (i && list[i].gain > list[i - 1].gain))
        broken("hypotheses are finite, and those of most gain come first");
  }
  void askConfidence() {
    const double within_m = anyNumber(&reader_), within_rad = anyNumber(&reader_);
    const double p = sphc_localizer_result_confidence(&result_, within_m, within_rad);
    if (!(p >= 0 && p <= 1)) broken("a confidence is a probability");
  }
  void convertCamera() {
    const auto convention = static_cast<sphc_convention>(around(1 + reader_.next() % 6, &reader_));
    sphc_rigid world = {}, camera = {}, back = {};
    fill(&world, &reader_);
    fill(&camera, &reader_);
    double pose[7];
    if (sphc_convention_write_camera(convention, &world, &camera, pose, nullptr) != SPHC_OK) return;
    if (!isFinite(pose, 7)) broken("a pose that is written is finite");
    if (sphc_convention_read_camera(convention, &world, pose, &back, nullptr) == SPHC_OK && !isFinite(back.t_m, 3))
      broken("a pose that is read is finite");
  }
  void convertMap() {
    const auto convention = static_cast<sphc_convention>(around(1 + reader_.next() % 6, &reader_));
    double up_map[3];
    for (double &part : up_map) part = anyNumber(&reader_);
    sphc_rigid world;
    double pose[7];
    if (sphc_convention_make_world(convention, up_map, &world, nullptr) != SPHC_OK) return;
    if (sphc_convention_write_map(convention, &world, pose, nullptr) != SPHC_OK)
      broken("a world that is made can be written");
    if (sphc_convention_read_map(convention, pose, &world, nullptr) != SPHC_OK)
      broken("what is written can be read");
  }
  uint32_t anyId() { return around(reader_.next() % kMaps, &reader_); }

  SessionMaterial &material_;
  Reader &reader_;
  test::GuardedMemory state_, scratch_, features_memory_;
  sphc_localizer *localizer_ = nullptr;
  sphc_features *features_ = nullptr;
  Roomy<sphc_localizer_prior> prior_;
  Roomy<sphc_localizer_view> view_;
  Roomy<sphc_localizer_depth_view> depth_view_;
  sphc_camera camera_ = {}, depth_camera_ = {};  // what a view points to
  sphc_rigid mount_ = {};
  sphc_localizer_result result_ = {};
  int64_t time_ns_ = 0;
};

}  // namespace

void session(const uint8_t *data, size_t bytes) {
  static SessionMaterial *material = new SessionMaterial;
  Reader reader(data, bytes);
  Play play(material, &reader);
  for (uint32_t calls = 0; calls < kMostCalls && !reader.isAtEnd(); ++calls) play.call();
}

}  // namespace sphc::fuzz
