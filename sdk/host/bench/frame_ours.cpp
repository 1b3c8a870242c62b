#include "host/bench/frame_ours.h"

#include <limits>
#include <memory>
#include <stdexcept>

namespace sphc::host {
namespace {

constexpr double kPriorRad = 0.05, kPriorM = 0.05;  // a headset's motion from frame to frame

int64_t threadNanoseconds(void *) { return static_cast<int64_t>(1e9 * threadSeconds()); }

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
    check(spherecloud::Localizer::make(config_, *map_, state_.data(), state_.size(), scratch_.data(),
                                       scratch_.size(), &localizer_));
  }

  FrameAnswer process(const sphc_frame &frame, sphc_result *result) {
    *result = spherecloud::emptyResult();
    const double begin = threadSeconds();
    const spherecloud::Status status = localizer_.process(frame, result);
    const double end = threadSeconds();
    check(status);
    return answerOf(*result, end - begin);
  }

 private:
  FrameAnswer answerOf(const sphc_result &result, double seconds) const {
    FrameAnswer answer;
    answer.pose.found = result.outcome == SPHC_OUTCOME_LOCALIZED;
    const Rigid map_from_world = {Matrix3::Identity(), -centre_m_};
    answer.pose.camera_from_map = rigidFromDoor(result.camera_from_map) * map_from_world;
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
  sphc_config config_;
  Vector3 centre_m_;
  sphc_memory need_ = {};
  spherecloud::AlignedBuffer state_, scratch_;
  spherecloud::Localizer localizer_;
};

FrameVariant coldVariant(const OurFrames &ours) {
  const auto bench = std::make_shared<Bench>(ours);
  const auto run = [bench](const FrameCase &frame, uint32_t) {
    bench->restart();
    sphc_result result;
    return bench->process(frame.image, &result);
  };
  return {"ours, cold", run, "", bench->memory()};
}

// One walk through the recording.
struct Walk {
  explicit Walk(const OurFrames &ours) : bench(ours) { bench.restart(); }
  Bench bench;
  sphc_result last = spherecloud::emptyResult();
};

// The last answer, as odometry would carry it to this frame.
FrameAnswer track(Walk *walk, sphc_frame frame) {
  sphc_prior prior = {};
  prior.struct_size = sizeof prior;
  prior.flags = SPHC_PRIOR_POSE;
  prior.camera_from_map = walk->last.camera_from_map;
  prior.rotation_sigma_rad = kPriorRad;
  prior.translation_sigma_m = kPriorM;
  if (walk->last.time_ns != 0 && walk->last.outcome == SPHC_OUTCOME_LOCALIZED) frame.prior = &prior;
  return walk->bench.process(frame, &walk->last);
}

FrameVariant trackingVariant(const OurFrames &ours) {
  std::vector<std::shared_ptr<Walk>> walks;
  for (uint32_t i = 0; i < ours.repeats; ++i) walks.push_back(std::make_shared<Walk>(ours));
  const FrameMemory memory = walks[0]->bench.memory();
  const auto run = [walks](const FrameCase &frame, uint32_t repeat) {
    return track(walks[repeat].get(), frame.image);
  };
  return {"ours, tracking", run, "", memory};
}

}  // namespace

std::vector<FrameVariant> ourFrameVariants(const OurFrames &ours) {
  return {coldVariant(ours), trackingVariant(ours)};
}

}  // namespace sphc::host
