#include "host/mapping/walk.h"

#include <algorithm>
#include <stdexcept>

#include "host/base/median.h"

namespace sphc::host {
namespace {

constexpr double kLeastShift = 0.02, kMostShift = 0.2;
constexpr double kFewFrames = 300;  // of a walk whose keyframes may lie as near as the least
constexpr LinkDemands kFollows = {40, 0.5};

double middleDepth(const std::vector<WalkFrame> &frames) {
  std::vector<double> depths;
  for (const WalkFrame &frame : frames)
    for (const SeenPoint &point : frame.points)
      if (point.hasDepth()) depths.push_back(point.depth_m);
  return median(std::move(depths));
}

// Takes the last keyframe out again where it follows the one before.
void compareLast(double keyframe_shift, FrameLinker *linker, Walk *walk) {
  if (walk->keyframes.size() < 2) return;
  const auto last = static_cast<uint32_t>(walk->keyframes.size() - 1);
  const auto link = linker->link(walk->keyframes, {last - 1, last}, kFollows);
  if (!link || shiftOf(*link, walk->keyframes) > keyframe_shift) return;
  walk->followers.push_back({0, walk->keyframes.back().index, last - 1, link->b_from_a.inverse()});
  walk->keyframes.pop_back();
}

}  // namespace

Walk joinWalks(std::vector<Walk> walks) {
  Walk all;
  for (uint32_t recording = 0; recording < walks.size(); ++recording) {
    const auto before = static_cast<uint32_t>(all.keyframes.size());
    for (WalkFrame &frame : walks[recording].keyframes) {
      all.keyframes.push_back(std::move(frame));
      all.keyframes.back().recording = recording;
    }
    for (Follower follower : walks[recording].followers) {
      follower.recording = recording;
      follower.keyframe += before;
      all.followers.push_back(follower);
    }
    all.unreadable += walks[recording].unreadable;
    if (all.first_fault.empty()) all.first_fault = walks[recording].first_fault;
  }
  all.middle_depth_m = middleDepth(all.keyframes);
  return all;
}

double keyframeShift(uint32_t frames) {
  return std::clamp(kLeastShift * frames / kFewFrames, kLeastShift, kMostShift);
}

double shiftOf(const FrameLink &link, const std::vector<WalkFrame> &frames) {
  std::vector<double> shifts;
  for (const PointMatch &match : link.matches)
    shifts.push_back(
        (frames[link.frames.a].points[match.a].ray - frames[link.frames.b].points[match.b].ray).norm());
  return median(std::move(shifts));
}

Walk readWalk(recording::RecordingReader *reader, const FrameReaderOptions &options, const WalkProgress &progress) {
  return readWalk(reader, reader->calibration(), options, progress);
}

Walk readWalk(recording::RecordingReader *reader, const sphc_rig &calibration, const FrameReaderOptions &options,
              const WalkProgress &progress) {
  FrameReader frames(calibration, options);
  FrameLinker linker(options.max_keypoints);
  const double keyframe_shift = keyframeShift(reader->frameCount());
  Walk walk;
  int64_t before_ns = 0;
  for (uint32_t i = 0; i < reader->frameCount(); ++i) {
    std::string why;
    if (const std::optional<sphc_localizer_frame> images = reader->tryRead(i, &why)) {
      walk.keyframes.push_back(frames.describe(*images));
      walk.keyframes.back().index = i;
      const int64_t time_ns = reader->colorOf(i).time_ns;
      walk.keyframes.back().time_ns = time_ns;
      if (walk.keyframes.size() > 1) walk.keyframes.back().gap_ns = time_ns - before_ns;
      before_ns = time_ns;
      compareLast(keyframe_shift, &linker, &walk);
    } else if (walk.unreadable++ == 0) {
      walk.first_fault = why;
    }
    if (progress) progress(i + 1, reader->frameCount());
  }
  if (walk.keyframes.empty())
    throw std::runtime_error("not one frame can be read: of " + std::to_string(walk.unreadable) +
                             " the first says: " + walk.first_fault);
  walk.middle_depth_m = middleDepth(walk.keyframes);
  if (!(walk.middle_depth_m > 0))
    throw std::runtime_error(
        "no keypoint has depth: do the images show something, are depth images and depth_unit_m of the "
        "calibration right, does depth fall on the colour images by its color_from_depth (metres, from depth to "
        "colour, x right, y down, z forward; `spherecloud doctor` tells), and is the room within --depth-min and "
        "--depth-max?");
  return walk;
}

}  // namespace sphc::host
