#include "host/import/rgbd_import.h"

#include <cmath>
#include <cstdlib>

#include "host/base/counted.h"
#include "host/base/median.h"
#include "host/frames/frame_features.h"
#include "host/frames/frame_images.h"
#include "host/frames/recording.h"
#include "host/import/fixed_in_image.h"
#include "host/import/moving_things.h"
#include "host/import/point_tracks.h"
#include "host/import/pose_scale.h"
#include "host/import/rolling_rows.h"
#include "runtime/stages/align/sparse.h"

namespace sphc::host {
namespace {

constexpr double kPixelSigma = 1.0, kPoseSigmaM = 0.002;
constexpr double kSamePose = 1e-12;        // interpolating between equal poses rounds
constexpr int64_t kFarApartNs = 10000000;  // between colour and depth: 5 mm of a walk

// The device's own stages, in memory from the workstation's heap.
class FrameDescriber {
 public:
  FrameDescriber(const sphc_rig &calibration, const DepthCalibration &depth, const RgbdImportOptions &options)
      : camera_(calibration.color_camera),
        depth_camera_(calibration.depth_camera),
        color_from_depth_(rigidFromC(calibration.color_from_depth)),
        depth_(depth),
        features_(camera_.width(), camera_.height(), options.max_keypoints) {
    aligner_.init({calibration.depth_unit_m, options.depth_min_m, options.depth_max_m, kMappingNoise.sigma_m,
                   kMappingNoise.sigma_per_m2});
  }

  const Camera &camera() const { return camera_; }

  // camera_from_camera_at_depth: from the colour camera where it was when depth was taken, to where it was when
  // colour was.
  std::vector<Observation> describe(const sphc_localizer_frame &frame, const Rigid &world_from_camera,
                                    const Rigid &camera_from_camera_at_depth, const RollingRows &rows,
                                    uint32_t *keypoints) {
    aligner_.setCameras(camera_, depth_camera_, camera_from_camera_at_depth * color_from_depth_);
    features_.extract(grayOf(frame.color, &gray_));
    *keypoints = features_.count();
    const ImageView<uint16_t> depth = depthOf(frame.depth);
    std::vector<Observation> observations;
    for (uint32_t i = 0; i < *keypoints; ++i) {
      Vector2 pixel = features_.pixel(i);
      Vector3 point;
      double sigma = 0;
      if (!lift(depth, pixel, &point, &sigma)) continue;
      // Depth was measured at one time for all rows.
      if (rows.roll() && !(rows.toMiddle(point, &pixel) && lift(depth, pixel, &point, &sigma))) continue;
      Observation o;
      o.position_m = world_from_camera * point;
      o.camera_m = world_from_camera.translation_m;
      o.information = information(point, sigma, world_from_camera.rotation);
      o.image_px = features_.pixel(i);
      o.pixel_px = pixel;
      o.depth_m = point.z();
      o.sigma_m = sigma;
      o.metric_scale_m =
          static_cast<double>(features_.keypoint(i).scale_px) * camera_.awayM(point) / camera_.focal();
      o.descriptor = features_.descriptor(i);
      observations.push_back(o);
    }
    return observations;
  }

 private:
  bool lift(ImageView<uint16_t> depth, const Vector2 &pixel, Vector3 *point, double *sigma) const {
    if (!aligner_.lift(depth, pixel, point, sigma)) return false;
    *point *= 1 + depth_.correctionAt(point->z()) / point->z();
    return true;
  }

  // Exact across the view, uncertain along it.
  Matrix3 information(const Vector3 &point, double sigma, const Matrix3 &world_from_camera) const {
    const Vector3 view = world_from_camera * point.normalized();
    const double across_px = kPixelSigma * camera_.awayM(point) / camera_.focal();
    const double across2 = across_px * across_px + kPoseSigmaM * kPoseSigmaM;
    const double along2 = sigma * sigma + kPoseSigmaM * kPoseSigmaM;
    return Matrix3::Identity() / across2 + (1 / along2 - 1 / across2) * view * view.transpose();
  }

  Camera camera_, depth_camera_;
  Rigid color_from_depth_;
  DepthCalibration depth_;
  FrameFeatures features_;
  std::vector<uint8_t> gray_;
  SparseAligner aligner_;
};

// What the frames were like, and why no map comes of them.
class Census {
 public:
  void pose(const sphc_rigid &pose) {
    if (++poses_ == 1) first_ = pose;
    for (int i = 0; i < 4; ++i) moved_ = moved_ || std::abs(pose.q_wxyz[i] - first_.q_wxyz[i]) > kSamePose;
    for (int i = 0; i < 3; ++i) moved_ = moved_ || std::abs(pose.t_m[i] - first_.t_m[i]) > kSamePose;
  }
  // `told`: one of the recordings whose poses, `told_poses` in all, would count if a frame had their times.
  void check(const RgbdImportSummary &s, uint64_t told_poses, const recording::RecordingReader *told) const {
    const auto count = [](uint64_t n) { return std::to_string(n); };
    if (s.frames_used == 0 && s.frames_unreadable > 0)
      throw std::runtime_error("not one frame can be read: of " + count(s.frames_unreadable) +
                               " with a pose the first says: " + s.first_unreadable);
    if (s.frames_used == 0 && told_poses > 0)
      throw std::runtime_error("none of " + counted(told_poses, "pose") +
                               ofOtherTimes(*told, told->recording().poses));
    if (s.frames_used == 0)
      throw std::runtime_error(
          "no frame of the recording has both images and a pose; a map needs poses (*.pose.txt, "
          "groundtruth.txt or --poses-from FILE); spherecloud map finds them where there are none");
    if (poses_ > 1 && !moved_)
      throw std::runtime_error("all " + count(poses_) +
                               " poses are the same; a map needs the pose that each frame was really taken from");
  }

 private:
  sphc_rigid first_ = {};
  uint32_t poses_ = 0;
  bool moved_ = false;
};

class Importer {
 public:
  Importer(const RgbdImportOptions &options, const Progress &progress, RgbdImportSummary *summary)
      : options_(options), progress_(progress), tracks_(options), summary_(summary) {
    *summary = {};
  }

  PointModel import(const std::vector<RgbdSource> &recordings) {
    uint64_t told_poses = 0;
    const recording::RecordingReader *told = nullptr;
    for (const RgbdSource &source : recordings) {
      total_ += source.reader->frameCount();
      if (source.poses) continue;
      told_poses += source.reader->recording().poses.poses().size();
      told = source.reader;
    }
    for (const RgbdSource &source : recordings) add(source);
    census_.check(*summary_, told_poses, told);
    std::vector<TrackedPoint> points = tracks_.points();
    if (!options_.keep_moving) summary_->fixed_in_image = fixed_.dropFrom(&points);
    summary_->moving = dropMoving(views_, &points);
    PointModel model = modelOf(points);
    summary_->scale = scale_.result();
    summary_->scale_parts = scale_.parts();
    summary_->points_kept = static_cast<uint32_t>(model.points.size());
    summary_->points_dropped = static_cast<uint32_t>(tracks_.count() - model.points.size());
    return model;
  }

 private:
  void add(const RgbdSource &source) {
    const sphc_rig &rig = source.reader->calibration();
    FrameDescriber describer(rig, source.depth, options_);
    RollingRows rows(describer.camera(), options_.row_time_ns);
    FrameConsistency consistency(rig, options_.depth_min_m, options_.depth_max_m);
    views_.emplace_back(rig, options_.depth_min_m, options_.depth_max_m);
    fixed_.begin(describer.camera());
    scale_.begin(describer.camera(), posedFrames(source));
    for (uint32_t i = 0; i < source.reader->frameCount(); ++i) {
      if (takesPart(source, i)) addFrame(source, i, &describer, &rows, &consistency);
      if (progress_) progress_(++done_, total_);
    }
  }

  static bool takesPart(const RgbdSource &source, uint32_t i) { return !source.takes_part || source.takes_part(i); }
  // Those that the scale is told by.
  static uint32_t posedFrames(const RgbdSource &source) {
    uint32_t frames = 0;
    for (uint32_t i = 0; i < source.reader->frameCount(); ++i)
      frames += takesPart(source, i) && poseAt(source, source.reader->colorOf(i).time_ns);
    return frames;
  }

  void addFrame(const RgbdSource &source, uint32_t i, FrameDescriber *describer, RollingRows *rows,
                FrameConsistency *consistency) {
    const std::optional<sphc_rigid> pose = poseAt(source, source.reader->colorOf(i).time_ns);
    std::string why;
    const std::optional<sphc_localizer_frame> frame = pose ? source.reader->tryRead(i, &why) : std::nullopt;
    if (!pose) {
      addFrameWithoutPose(source, i);
    } else if (!frame) {
      if (++summary_->frames_unreadable == 1) summary_->first_unreadable = why;
    } else {
      census_.pose(*pose);
      const Rigid world_from_camera = rigidFromC(*pose);
      const Rigid camera_from_camera_at_depth = cameraFromCameraAtDepth(source, *frame, world_from_camera);
      summary_->frames_with_fault.add(consistency->look(frame->color, frame->color_time_ns, frame->depth,
                                                        frame->depth_time_ns, camera_from_camera_at_depth));
      summary_->frames_bent +=
          !rows->begin(frame->color_time_ns, *pose, [&source](int64_t time_ns) { return poseAt(source, time_ns); });
      place(*frame, source.reader->colorOf(i).sequence, world_from_camera, camera_from_camera_at_depth, *rows,
            describer);
    }
  }

  void addFrameWithoutPose(const RgbdSource &source, uint32_t i) {
    ++summary_->frames_without_pose;
    if (source.poses) return;
    const auto gap_ns = poseGapOf(*source.reader, source.reader->recording().poses, i);
    if (gap_ns && *gap_ns <= uint64_t{kMostPoseGapMs} * 1000000)
      summary_->pose_gaps_ms.push_back(1e-6 * static_cast<double>(*gap_ns));
  }

  static std::optional<sphc_rigid> poseAt(const RgbdSource &source, int64_t time_ns) {
    return source.poses ? source.poses(time_ns) : source.reader->worldFromCameraAt(time_ns);
  }

  // As it is to describe(); that of a camera which rests where nothing tells.
  Rigid cameraFromCameraAtDepth(const RgbdSource &source, const sphc_localizer_frame &frame,
                                const Rigid &world_from_camera) {
    if (frame.depth_time_ns == frame.color_time_ns) return {};
    const std::optional<sphc_rigid> then = poseAt(source, frame.depth_time_ns);
    if (then) return world_from_camera.inverse() * rigidFromC(*then);
    summary_->frames_apart += std::abs(frame.depth_time_ns - frame.color_time_ns) > kFarApartNs;
    return {};
  }

  void place(const sphc_localizer_frame &frame, uint32_t sequence, const Rigid &world_from_camera,
             const Rigid &camera_from_camera_at_depth, const RollingRows &rows, FrameDescriber *describer) {
    uint32_t keypoints = 0;
    std::vector<Observation> observations =
        describer->describe(frame, world_from_camera, camera_from_camera_at_depth, rows, &keypoints);
    for (Observation &o : observations) o.recording = static_cast<uint32_t>(views_.size() - 1);
    scale_.add(sequence, world_from_camera, observations);
    if (!options_.keep_moving) {
      views_.back().add(depthOf(frame.depth), world_from_camera * camera_from_camera_at_depth);
      fixed_.add(world_from_camera.inverse(), &observations);
    }
    summary_->merged += tracks_.add(describer->camera(), world_from_camera.inverse(), observations);
    summary_->keypoints += keypoints;
    summary_->lifted += observations.size();
    ++summary_->frames_used;
    summary_->frames_empty += observations.empty();
  }

  const RgbdImportOptions &options_;
  const Progress &progress_;
  PointTracks tracks_;
  FixedInImage fixed_;
  PoseScaleCheck scale_;
  std::vector<DepthViews> views_;  // of each recording
  Census census_;
  RgbdImportSummary *summary_;
  uint32_t done_ = 0, total_ = 0;
};

}  // namespace

PointModel importRgbd(const std::vector<RgbdSource> &recordings, const RgbdImportOptions &options,
                      const Progress &progress, RgbdImportSummary *summary) {
  return Importer(options, progress, summary).import(recordings);
}

namespace {

// Why so many frames have no pose; empty where it is not the distance of poses.
std::string betweenPoses(const std::vector<double> &gaps_ms) {
  if (gaps_ms.empty()) return "";
  return ": poses around " + std::to_string(gaps_ms.size()) + " of them are " +
         std::to_string(std::llround(median(gaps_ms))) +
         " ms apart, too far to interpolate; --pose-gap-ms takes more";
}

}  // namespace

std::vector<std::string> framesLeftOut(const RgbdImportSummary &summary) {
  std::vector<std::string> sentences;
  if (summary.frames_without_pose)
    sentences.push_back(counted(summary.frames_without_pose, "frame") + " without a pose took no part" +
                        betweenPoses(summary.pose_gaps_ms));
  if (summary.frames_unreadable)
    sentences.push_back(counted(summary.frames_unreadable, "frame") +
                        " could not be read and took no part; the first: " + summary.first_unreadable);
  if (summary.frames_apart)
    sentences.push_back("depth of " + counted(summary.frames_apart, "frame") +
                        " was taken more than 10 ms before or after colour, and no poses near enough in time tell "
                        "how the camera moved between, so points lie beside their places; record poses at 20 Hz or "
                        "more, or take both images at one time");
  if (summary.frames_bent)
    sentences.push_back(
        "no poses near enough in time tell how the camera moved while the rows of " +
        counted(summary.frames_bent, "frame") +
        " were exposed, so points lie beside their places where it turned; give poses (map: frames) at 20 Hz or "
        "more");
  if (summary.frames_empty)
    sentences.push_back(counted(summary.frames_empty, "frame") +
                        " gave nothing: too dark, too blurred, or without depth where there is something to see");
  return sentences;
}

}  // namespace sphc::host
