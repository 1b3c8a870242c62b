// Recordings of the app Record3D: its own .r3d, a zip or what was in it, and what it exports as "EXR + RGB".
#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/confidence.h"
#include "host/recording/foreign/exr_depth.h"
#include "host/recording/foreign/file_set.h"
#include "host/recording/foreign/r3d_depth.h"
#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/foreign/scaled_camera.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr const char *kRecord3dInner = "EXR_RGBD";
constexpr uint8_t kLeastR3dConfidence = 1;  // of ARKit: 0 low, 1 medium, 2 high

// How files are named.
struct Record3dNames {
  const char *metadata, *color, *depth, *depth_ending;
};
constexpr Record3dNames kExrNames = {"metadata.json", "rgb/", "depth/", ".exr"};
constexpr Record3dNames kR3dNames = {"metadata", "rgbd/", "rgbd/", ".depth"};

std::unique_ptr<FileSet> filesOf(const fs::path &path) {
  return fs::is_directory(path) ? filesOfFolder(path) : filesOfZip(path);
}

bool isNamed(const fs::path &folder, const Record3dNames &names) {
  return fs::is_directory(folder / names.color) && fs::is_directory(folder / names.depth);
}

// Where the images are: the folder or the one in it.
fs::path imagesFolder(const fs::path &folder) {
  return fs::is_directory(folder / kRecord3dInner) ? folder / kRecord3dInner : folder;
}

class Record3dImages : public LayoutImages {
 public:
  explicit Record3dImages(std::unique_ptr<FileSet> files) : files_(std::move(files)) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override {
    files_->read(image.file, encoded_);
    if (stream == SPHC_STREAM_DEPTH)
      readDepth(image.file, camera, reinterpret_cast<uint16_t *>(pixels));
    else
      decodeImage(viewOf(encoded_), imageTypeOf(image.file), camera, format, pixels);
  }

 private:
  void readDepth(const fs::path &file, const sphc_camera &camera, uint16_t *depth_mm) {
    if (file.extension() == kExrNames.depth_ending) return decodeExrDepth(viewOf(encoded_), camera, depth_mm);
    decodeR3dDepth(viewOf(encoded_), camera, depth_mm);
    const std::string confidence = fs::path(file).replace_extension(".conf").string();
    if (!files_->has(confidence)) return;  // of the camera in front
    try {
      files_->read(confidence, encoded_);
      if (encoded_.empty()) return;  // likewise
      decodeR3dConfidence(viewOf(encoded_), camera, confidence_);
    } catch (const Failure &failure) {
      throw Failure(failure.status(), "its confidence, " + confidence + ": " + failure.what());
    }
    dropLowConfidence(confidence_, kLeastR3dConfidence, depth_mm);
  }

  std::unique_ptr<FileSet> files_;
  Bytes encoded_, confidence_;
};

std::string colorFileOf(const FileSet &files, const Record3dNames &names, size_t number) {
  for (const char *ending : {".jpg", ".png"}) {
    const std::string file = names.color + std::to_string(number) + ending;
    if (files.has(file)) return file;
  }
  return "";
}

void addFrames(const Record3dMetadata &metadata, const FileSet &files, const Record3dNames &names,
               Recording &recording) {
  const std::string name = shortPath(recording.path.string());
  for (size_t i = 0; i < metadata.time_ns.size(); ++i) {
    const int64_t time_ns = metadata.time_ns[i];
    const uint32_t number = static_cast<uint32_t>(i);
    const std::string color = colorFileOf(files, names, i),
                      depth = names.depth + std::to_string(i) + names.depth_ending;
    if (!color.empty())
      recording.color.push_back({time_ns, number, color});
    else
      ++recording.lost_count;
    if (files.has(depth)) recording.depth.push_back({time_ns, number, depth});
    if (metadata.world_from_camera[i])
      recording.poses.add(time_ns, *metadata.world_from_camera[i]);
    else
      ++recording.bad_pose_count;
  }
  for (size_t i = metadata.time_ns.size(); !colorFileOf(files, names, i).empty(); ++i) ++recording.lost_count;
  if (recording.color.empty())
    throw Failure(SPHC_E_DEVICE, name + ": no " + names.color + "0.jpg and so on; copy them too");
  if (recording.depth.empty())
    throw Failure(SPHC_E_DEVICE,
                  name + ": no " + names.depth + "0" + names.depth_ending + " and so on; copy them too");
}

template <typename Read>
auto readNamed(FileSet &files, const fs::path &path, const std::string &file, Read &&read) {
  try {
    Bytes bytes;
    files.read(file, bytes);
    return read(viewOf(bytes));
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath((path / file).string()) + ": " + failure.what());
  }
}

sphc_rig rigOfRecord3d(const Record3dMetadata &metadata, FileSet &files, const Recording &recording) {
  const std::string &color_file = recording.color.front().file, &depth_file = recording.depth.front().file;
  const ImageSize color = readNamed(files, recording.path, color_file,
                                    [&](ByteView file) { return imageSizeOf(file, imageTypeOf(color_file)); });
  const std::string name = shortPath(recording.path.string());
  if (color.width != metadata.width || color.height != metadata.height)
    throw Failure(SPHC_E_IMAGE, name +
                                    ": its images are not of the size in its metadata (w, h); give them as they "
                                    "were exported, neither turned nor scaled");
  const ImageSize depth = readNamed(files, recording.path, depth_file, [&](ByteView file) {
    return fs::path(depth_file).extension() == kExrNames.depth_ending ? exrSizeOf(file)
                                                                      : r3dDepthSizeOf(file, metadata);
  });
  return oneCameraRig(metadata.params, color, depth, name);
}

// The files of an export may be in a folder of their own, without the metadata.
Record3dMetadata metadataOf(FileSet &files, const fs::path &path, const Record3dNames &names) {
  const auto parse = [](ByteView text) { return record3dMetadataFrom(textOf(text)); };
  if (files.has(names.metadata) || path.filename() != kRecord3dInner)
    return readNamed(files, path, names.metadata, parse);
  return readNamed(*filesOfFolder(path.parent_path()), path.parent_path(), names.metadata, parse);
}

bool isUnzippedR3d(const fs::path &folder) {
  return isNamed(folder, kR3dNames) && fs::exists(folder / kR3dNames.metadata);
}

bool isExport(const fs::path &folder) {
  const fs::path images = imagesFolder(folder);
  return isNamed(images, kExrNames) &&
         (fs::exists(folder / kExrNames.metadata) || fs::exists(images / kExrNames.metadata));
}

}  // namespace

bool isRecord3d(const fs::path &path) {
  return fs::is_directory(path) ? isUnzippedR3d(path) || isExport(path) : isZip(path);
}

Recording openRecord3d(const fs::path &path) {
  Recording recording;
  recording.layout = Layout::kRecord3d;
  const bool is_r3d = !fs::is_directory(path) || isUnzippedR3d(path);
  const Record3dNames &names = is_r3d ? kR3dNames : kExrNames;
  recording.path = is_r3d ? path : imagesFolder(path);
  recording.is_by_frame = true;
  const std::unique_ptr<FileSet> files = filesOf(recording.path);
  if (is_r3d && !files->has(names.metadata))
    throw Failure(SPHC_E_UNSUPPORTED, shortPath(path.string()) +
                                          ": is a zip, and none of Record3D's, which have metadata and rgbd/ in "
                                          "them; unzip it and give the folder");
  const Record3dMetadata metadata = metadataOf(*files, recording.path, names);
  recording.images = [path = recording.path] { return std::make_unique<Record3dImages>(filesOf(path)); };
  addFrames(metadata, *files, names, recording);
  try {
    recording.calibration = rigOfRecord3d(metadata, *files, recording);
  } catch (const Failure &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = failure.what();
  }
  return recording;
}

}  // namespace sphc::recording
