// Recordings of the app StrayScanner: a video, depth and confidence a frame, poses of ARKit.
#include <cstdio>

#include "host/recording/calibration_json.h"
#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/confidence.h"
#include "host/recording/foreign/scaled_camera.h"
#include "host/recording/foreign/stray_text.h"
#include "host/recording/foreign/video.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr uint8_t kLeastConfidence = 1;  // of ARKit: 0 low, 1 medium, 2 high
constexpr size_t kMostImageBytes = size_t{1} << 28;

std::string numberedFile(const char *folder, uint32_t number, const char *ending) {
  char name[32];
  std::snprintf(name, sizeof name, "/%06u%s", number, ending);
  return folder + std::string(name);
}

// The name of a colour image that was taken out of the video; empty without one.
std::string imageFile(const fs::path &folder, uint32_t number) {
  for (const char *ending : {".jpg", ".png"}) {
    const std::string file = numberedFile("rgb", number, ending);
    if (fs::exists(folder / file)) return file;
  }
  return "";
}

class StrayImages : public LayoutImages {
 public:
  explicit StrayImages(fs::path folder) : folder_(std::move(folder)) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override {
    if (stream == SPHC_STREAM_DEPTH)
      readDepth(image, camera, pixels);
    else if (image.file == "rgb.mp4")
      readVideo(image, camera, format, pixels);
    else
      decodeImage(load(image.file), imageTypeOf(image.file), camera, format, pixels);
  }

 private:
  ByteView load(const std::string &file) {
    readFile(folder_ / file, kMostImageBytes, encoded_);
    return viewOf(encoded_);
  }

  void readVideo(const RecordedImage &image, const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
    if (!video_) video_ = std::make_unique<Video>(folder_ / image.file);
    const sphc_image frame = video_->read(image.sequence);
    requireSize(frame.width, frame.height, camera, true);
    packPixels(frame, format, pixels);
  }

  void readDepth(const RecordedImage &image, const sphc_camera &camera, uint8_t *pixels) {
    decodeImage(load(image.file), ImageType::kPng, camera, SPHC_FORMAT_DEPTH16, pixels);
    if (!fs::exists(folder_ / "confidence")) return;
    confidence_.resize(size_t{camera.width} * camera.height);
    const std::string file = numberedFile("confidence", image.sequence, ".png");
    try {
      decodeImage(load(file), ImageType::kPng, camera, SPHC_FORMAT_GRAY8, confidence_.data());
    } catch (const Failure &failure) {
      throw Failure(failure.status(), "its confidence, " + file + ": " + failure.what());
    }
    dropLowConfidence(confidence_, kLeastConfidence, reinterpret_cast<uint16_t *>(pixels));
  }

  fs::path folder_;
  std::unique_ptr<Video> video_;
  Bytes encoded_, confidence_;
};

template <typename Parse>
auto parsedFile(const fs::path &file, Parse &&parse) {
  const std::string text = readText(file);
  try {
    return parse(text);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath(file.string()) + ", " + failure.what());
  }
}

ImageSize sizeInFile(const fs::path &folder, const std::string &file) {
  try {
    Bytes encoded;
    readFile(folder / file, kMostImageBytes, encoded);
    return imageSizeOf(viewOf(encoded), imageTypeOf(file));
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath((folder / file).string()) + ": " + failure.what());
  }
}

struct StrayColor {
  ImageSize size;
  uint32_t frame_count;  // of the video
  bool is_video;
};

StrayColor findColor(const fs::path &folder, const StrayOdometry &odometry) {
  if (!fs::exists(folder / "rgb")) {
    const Video video(folder / "rgb.mp4");
    return {{video.width(), video.height()}, video.frameCount(), true};
  }
  for (const StrayFrame &frame : odometry.frames)
    if (const std::string file = imageFile(folder, frame.number); !file.empty())
      return {sizeInFile(folder, file), 0, false};
  throw Failure(SPHC_E_DEVICE, shortPath(folder.string()) +
                                   ": holds no image rgb/000000.jpg or .png; remove the empty folder rgb to read "
                                   "rgb.mp4");
}

void addImages(const StrayOdometry &odometry, const StrayColor &color, Recording &recording) {
  for (const StrayFrame &frame : odometry.frames) {
    const fs::path &folder = recording.path;
    const std::string depth = numberedFile("depth", frame.number, ".png");
    const bool is_in_video = color.is_video && frame.number < color.frame_count;
    const std::string file = is_in_video ? "rgb.mp4" : color.is_video ? "" : imageFile(folder, frame.number);
    if (!file.empty())
      recording.color.push_back({frame.time_ns, frame.number, file});
    else
      ++recording.lost_count;
    if (fs::exists(folder / depth)) recording.depth.push_back({frame.time_ns, frame.number, depth});
    if (frame.world_from_camera)
      recording.poses.add(frame.time_ns, *frame.world_from_camera);
    else
      ++recording.bad_pose_count;
  }
  const std::string name = shortPath(recording.path.string());
  if (recording.color.empty())
    throw Failure(SPHC_E_DEVICE, name + ": its video has none of the frames of odometry.csv; copy both again");
  if (recording.depth.empty())
    throw Failure(SPHC_E_DEVICE, name +
                                     ": no depth/000000.png and so on; copy the folder depth too (an old version's "
                                     "depth of .npy files is not read)");
}

PinholeParams paramsOf(const fs::path &folder, const StrayOdometry &odometry) {
  if (odometry.params) return *odometry.params;
  const fs::path file = folder / "camera_matrix.csv";
  if (!fs::exists(file))
    throw Failure(SPHC_E_ARGUMENT, shortPath(file.string()) +
                                       ": is not there, and odometry.csv tells no camera; copy that file too, or "
                                       "give a calibration file");
  return parsedFile(file, strayCameraFrom);
}

sphc_rig rigOfStray(const StrayOdometry &odometry, const StrayColor &color, const Recording &recording) {
  return oneCameraRig(paramsOf(recording.path, odometry), color.size,
                      sizeInFile(recording.path, recording.depth.front().file), shortPath(recording.path.string()));
}

}  // namespace

// Two of its files tell it, so that the one that is missing can be named; rgb and depth are of other layouts too.
bool isStrayScanner(const fs::path &folder) {
  int own = 0, shared = 0;
  for (const char *name : {"odometry.csv", "camera_matrix.csv", "rgb.mp4", "confidence"})
    own += fs::exists(folder / name);
  for (const char *name : {"rgb", "depth"}) shared += fs::exists(folder / name);
  return own >= 1 && own + shared >= 2;
}

Recording openStrayScanner(const fs::path &folder) {
  Recording recording;
  recording.layout = Layout::kStrayScanner;
  recording.path = folder;
  recording.is_by_frame = true;
  recording.images = [folder] { return std::make_unique<StrayImages>(folder); };
  if (!fs::exists(folder / "odometry.csv"))
    throw Failure(SPHC_E_DEVICE, shortPath(folder.string()) +
                                     ": a recording of StrayScanner without odometry.csv, which has its times and "
                                     "poses; copy that too");
  const StrayOdometry odometry = parsedFile(folder / "odometry.csv", strayOdometryFrom);
  const StrayColor color = findColor(folder, odometry);
  addImages(odometry, color, recording);
  try {
    recording.calibration = rigOfStray(odometry, color, recording);
  } catch (const Failure &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = failure.what();
  }
  return recording;
}

}  // namespace sphc::recording
