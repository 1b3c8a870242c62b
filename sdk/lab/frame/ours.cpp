#include "lab/frame/ours.h"

#include <memory>
#include <stdexcept>

#include "lab/common/interleave.h"

namespace sphc::host {
namespace {

int64_t threadNanoseconds(void *) { return static_cast<int64_t>(1e9 * threadCpuSeconds()); }

void check(const spherecloud::Status &status) {
  if (status.failed()) throw std::runtime_error(std::string(status.text()) + " [" + status.name() + "]");
}

// Localizers of one configuration in memory that is made once.
class Bench {
 public:
  explicit Bench(const OurFrames &ours) : map_(ours.map), config_(ours.config), centre_m_(ours.centre_in_world_m) {
    config_.clock = threadNanoseconds;
    spherecloud::Status status;
    check(status.set(sphc_localizer_memory(&config_, &need_, status.message())));
    state_ = spherecloud::AlignedBuffer(need_.state_bytes, need_.alignment);
    scratch_ = spherecloud::AlignedBuffer(need_.scratch_bytes, need_.alignment);
    if (!state_.data() || !scratch_.data()) throw std::runtime_error("not enough memory for the localizer");
  }

  FrameMemory memory() const {
    return {need_.state_bytes, need_.scratch_bytes, static_cast<size_t>(map_->info().file_bytes)};
  }

  void restart() {
    localizer_ = {};
    check(spherecloud::Localizer::make(config_, state_.data(), state_.size(), scratch_.data(), scratch_.size(),
                                       &localizer_));
    check(localizer_.setMap(0, *map_));
  }

  FrameAnswer process(const sphc_localizer_frame &frame) {
    sphc_localizer_result result = spherecloud::emptyResult();
    const double begin = threadCpuSeconds();
    const spherecloud::Status status = localizer_.process(frame, &result);
    const double end = threadCpuSeconds();
    check(status);
    return answerOf(result, end - begin);
  }

 private:
  FrameAnswer answerOf(const sphc_localizer_result &result, double seconds) const {
    FrameAnswer answer;
    answer.pose.found = result.outcome == SPHC_OUTCOME_LOCALIZED;
    const Rigid map_from_world = {Matrix3::Identity(), -centre_m_};
    answer.pose.camera_from_map = rigidFromC(result.camera_from_map) * map_from_world;
    answer.pose.iterations = result.iterations;
    answer.pose.inliers = result.inliers;
    answer.pose.seconds = seconds;
    const auto set = [&answer](Stage stage, uint32_t us) { answer.stages[stage] = 1e-6 * us; };
    set(kFeatures, result.features_us);
    set(kAlign, result.align_us);
    set(kMatch, result.match_us);
    set(kPose, result.pose_us);
    return answer;
  }

  const spherecloud::Map *map_;
  sphc_localizer_config config_;
  Vector3 centre_m_;
  sphc_memory need_ = {};
  spherecloud::AlignedBuffer state_, scratch_;
  spherecloud::Localizer localizer_;
};

FrameVariant coldVariant(OurFrames ours) {
  ours.config.mode = SPHC_MODE_SINGLE;
  const auto bench = std::make_shared<Bench>(ours);
  const auto run = [bench](const FrameCase &frame, uint32_t) {
    bench->restart();
    return bench->process(frame.image);
  };
  return {"ours, cold", run, "", bench->memory()};
}

FrameVariant trackingVariant(const std::string &name, bool odometry, OurFrames ours) {
  ours.config.mode = SPHC_MODE_TRACKING;
  std::vector<std::shared_ptr<Bench>> walks;  // one through the recording for each repeat
  for (uint32_t i = 0; i < ours.repeats; ++i) {
    walks.push_back(std::make_shared<Bench>(ours));
    walks.back()->restart();
  }
  const auto run = [walks, odometry](const FrameCase &frame, uint32_t repeat) {
    sphc_localizer_frame image = frame.image;
    if (odometry) image.prior = frame.odometry;
    return walks[repeat]->process(image);
  };
  return {name, run, "", walks[0]->memory()};
}

}  // namespace

std::vector<FrameVariant> ourFrameVariants(const OurFrames &ours) {
  return {coldVariant(ours), trackingVariant("ours, tracking", false, ours),
          trackingVariant("ours, tracking with odometry", true, ours)};
}

}  // namespace sphc::host
