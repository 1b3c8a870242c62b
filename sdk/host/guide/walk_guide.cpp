#include "host/guide/walk_guide.h"

#include "host/base/in_seconds.h"
#include "host/base/median.h"
#include "host/mapping/view_speed.h"

namespace sphc::host {
namespace {

constexpr LinkDemands kFollows = {20, 0.25};
constexpr double kNewPlace = 0.15;      // shift of the view, as rays
constexpr uint32_t kFewestPoints = 40;  // with depth, of a frame that begins a part
constexpr uint32_t kFewestOfPart = 5;   // places; what is smaller is nothing to go back to
constexpr int64_t kLostNs = 1000000000;
constexpr int64_t kQuietNs = 5000000000;  // loops that follow each other faster are one

FrameReaderOptions readerOptions(const WalkGuide::Options &options) {
  FrameReaderOptions reader;
  reader.max_keypoints = options.max_keypoints;
  reader.depth_min_m = options.depth_min_m;
  reader.depth_max_m = options.depth_max_m;
  return reader;
}

std::vector<double> depthsOf(const WalkFrame &frame) {
  std::vector<double> depths;
  for (const SeenPoint &point : frame.points)
    if (point.hasDepth()) depths.push_back(point.depth_m);
  return depths;
}

}  // namespace

WalkGuide::WalkGuide(const sphc_rig &rig, const Options &options)
    : reader_(rig, readerOptions(options)), places_(options.max_keypoints), loop_search_(&places_) {}

GuideStep WalkGuide::look(const sphc_localizer_frame &images) {
  const WalkFrame frame = reader_.describe(images);
  now_ = {};
  now_.sequence = images.sequence;
  now_.time_ns = images.color_time_ns;
  GuideStep step;
  step.sequence = now_.sequence;
  step.time_ns = now_.time_ns;
  step.advice = adviceOf(frame.hints);
  const std::optional<Rigid> part_from_camera = follow(frame);
  if (part_from_camera) {
    if (isTooFast(*part_from_camera, frame)) step.advice |= kSlower;
    step.loop = closeLoop({&frame, last_, *part_from_camera});
  }
  looks_.push_back({now_.time_ns, step.advice, part_from_camera ? last_ : UINT32_MAX});
  if (part_from_camera && !isLone(last_) && now_.support < kThinInliers) step.advice |= kLookAgain;
  addLost(part_from_camera.has_value(), &step);
  step.places = places_.count();
  step.parts = places_.partCount();
  step.loops = loops_;
  return step;
}

// In the part of the place that is followed then; none where the frame agrees with nothing.
std::optional<Rigid> WalkGuide::follow(const WalkFrame &frame) {
  if (last_ != UINT32_MAX) {
    if (const auto pose = followFrom(last_, frame)) return pose;
    if (makePlaceOfPrevious())
      if (const auto pose = followFrom(last_, frame)) return pose;
  }
  if (before_ != UINT32_MAX)
    if (const auto pose = followFrom(before_, frame)) return pose;
  return beginPart(frame);
}

std::optional<Rigid> WalkGuide::followFrom(uint32_t place, const WalkFrame &frame) {
  const auto found = places_.link(place, frame, kFollows);
  if (!found) return std::nullopt;
  if (place != last_) dropLonePlace();
  last_ = place;
  before_ = UINT32_MAX;
  now_.part = places_[place].part;
  now_.part_from_camera = places_[place].part_from_camera * found->link.b_from_a.inverse();
  now_.support = found->link.inliers;
  if (found->shift > kNewPlace) {
    places_.support(place, now_.support);
    last_ = places_.add(frame, now_);
    previous_.reset();
  } else {
    previous_ = Beside{frame, now_};
  }
  return now_.part_from_camera;
}

// A view that moves fast may be nearer to the last frame than to the last place.
bool WalkGuide::makePlaceOfPrevious() {
  if (!previous_) return false;
  places_.support(last_, previous_->place.support);
  last_ = places_.add(previous_->frame, previous_->place);
  previous_.reset();
  return true;
}

bool WalkGuide::isLone(uint32_t place) const {
  return place + 1 == places_.count() && places_.sizeOf(places_[place].part) == 1;
}

// What agrees with nothing begins a part of its own, in place of another that nothing agreed with.
std::optional<Rigid> WalkGuide::beginPart(const WalkFrame &frame) {
  if (depthsOf(frame).size() < kFewestPoints) return std::nullopt;
  if (frame.hints != 0 && places_.count() > 0) return std::nullopt;  // it would agree with nothing later either
  if (last_ != UINT32_MAX && isLone(last_))
    dropLonePlace();
  else
    before_ = last_;
  now_.part = places_.newPart();
  last_ = places_.add(frame, now_);
  previous_.reset();
  return now_.part_from_camera;
}

void WalkGuide::dropLonePlace() {
  const uint32_t lone = places_.count() - 1;
  if (!isLone(lone)) return;
  for (Look &look : looks_)
    if (look.place == lone) look.place = UINT32_MAX;
  places_.removeLast();
  previous_.reset();
  loop_search_.forget();
}

std::optional<ClosedLoop> WalkGuide::closeLoop(const Located &here) {
  const std::optional<FoundLoop> found = loop_search_.look(here);
  if (!found) return std::nullopt;
  const GuidePlace then = places_[found->place];
  for (const uint32_t place : {found->place, here.place}) places_.support(place, found->inliers);
  places_.markSeenAgain(found->place);
  const bool is_new = then.part != now_.part || !loop_ns_ || now_.time_ns - *loop_ns_ > kQuietNs;
  loop_ns_ = now_.time_ns;
  if (then.part != now_.part) {
    const Rigid then_from_now =
        then.part_from_camera * (here.part_from_camera * found->camera_from_place).inverse();
    places_.join(now_.part, then.part, then_from_now);
    now_.part = then.part;
    now_.part_from_camera = then_from_now * now_.part_from_camera;
    if (previous_) previous_->place.part = then.part;
    if (previous_) previous_->place.part_from_camera = then_from_now * previous_->place.part_from_camera;
    loop_search_.forget();
  }
  loops_ += is_new;
  return ClosedLoop{then.sequence, then.time_ns, found->camera_from_place,
                    then.time_ns - looks_.front().time_ns < kBeginNs, is_new};
}

bool WalkGuide::isTooFast(const Rigid &part_from_camera, const WalkFrame &frame) const {
  if (!located_ || located_->part != now_.part) return false;
  const double seconds = inSeconds(now_.time_ns - located_->time_ns);
  const Rigid moved = located_->part_from_camera.inverse() * part_from_camera;
  const std::vector<double> depths = depthsOf(frame);
  const double depth_m = depths.empty() ? 1 : median(depths);
  return viewShift(moved, depth_m) > kFastPerS * seconds;
}

void WalkGuide::addLost(bool is_located, GuideStep *step) {
  located_ = is_located ? std::optional<GuidePlace>(now_) : std::nullopt;
  const uint32_t largest = places_.largestPart();
  if (largest == UINT32_MAX || (is_located && now_.part == largest)) whole_ns_ = now_.time_ns;
  if (now_.time_ns - whole_ns_ < kLostNs || places_.sizeOf(largest) < kFewestOfPart) return;
  step->advice |= kGoBack;
  step->lost_s = inSeconds(now_.time_ns - whole_ns_);
}

}  // namespace sphc::host
