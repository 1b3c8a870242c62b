// Recordings of the app Record3D, exported as "EXR + RGB".
#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/exr_depth.h"
#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/foreign/scaled_camera.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostRecord3dBytes = size_t{1} << 28;
constexpr const char *kRecord3dInner = "EXR_RGBD";

// Where rgb/ and depth/ are: the folder or the one in it.
fs::path imagesFolder(const fs::path &folder) {
  return fs::is_directory(folder / kRecord3dInner) ? folder / kRecord3dInner : folder;
}

fs::path metadataFile(const fs::path &folder) {
  const fs::path inner = folder / kRecord3dInner / "metadata.json";
  return fs::exists(inner) ? inner : folder / "metadata.json";
}

class Record3dImages : public LayoutImages {
 public:
  explicit Record3dImages(fs::path folder) : folder_(std::move(folder)) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override {
    readFile(folder_ / image.file, kMostRecord3dBytes, encoded_);
    if (stream == SPHC_STREAM_DEPTH)
      decodeExrDepth(viewOf(encoded_), camera, reinterpret_cast<uint16_t *>(pixels));
    else
      decodeImage(viewOf(encoded_), imageTypeOf(image.file), camera, format, pixels);
  }

 private:
  fs::path folder_;
  Bytes encoded_;
};

std::string record3dColor(const fs::path &folder, size_t number) {
  for (const char *ending : {".jpg", ".png"}) {
    const std::string file = "rgb/" + std::to_string(number) + ending;
    if (fs::exists(folder / file)) return file;
  }
  return "";
}

void addFrames(const Record3dMetadata &metadata, Recording &recording) {
  const std::string name = shortPath(recording.path.string());
  for (size_t i = 0; i < metadata.time_ns.size(); ++i) {
    const int64_t time_ns = metadata.time_ns[i];
    const uint32_t number = static_cast<uint32_t>(i);
    const std::string color = record3dColor(recording.path, i), depth = "depth/" + std::to_string(i) + ".exr";
    if (!color.empty()) recording.color.push_back({time_ns, number, color});
    if (fs::exists(recording.path / depth)) recording.depth.push_back({time_ns, number, depth});
    if (metadata.world_from_camera[i])
      recording.poses.add(time_ns, *metadata.world_from_camera[i]);
    else
      ++recording.bad_pose_count;
  }
  if (recording.color.empty()) throw Failure(SPHC_E_DEVICE, name + ": no rgb/0.jpg and so on; copy them too");
  if (recording.depth.empty()) throw Failure(SPHC_E_DEVICE, name + ": no depth/0.exr and so on; copy them too");
}

template <typename SizeOf>
ImageSize firstSize(const Recording &recording, const RecordedImage &image, SizeOf &&size_of) {
  try {
    Bytes encoded;
    readFile(recording.path / image.file, kMostRecord3dBytes, encoded);
    return size_of(viewOf(encoded));
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath((recording.path / image.file).string()) + ": " + failure.what());
  }
}

Record3dMetadata metadataOf(const fs::path &folder) {
  const fs::path file = metadataFile(folder);
  const std::string text = readText(file);
  try {
    return record3dMetadataFrom(text);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath(file.string()) + ", " + failure.what());
  }
}

sphc_rig rigOfRecord3d(const Record3dMetadata &metadata, const Recording &recording) {
  const RecordedImage &first = recording.color.front();
  const ImageSize color =
      firstSize(recording, first, [&](ByteView file) { return imageSizeOf(file, imageTypeOf(first.file)); });
  const ImageSize depth = firstSize(recording, recording.depth.front(), exrSizeOf);
  const std::string name = shortPath(recording.path.string());
  if (color.width != metadata.width || color.height != metadata.height)
    throw Failure(SPHC_E_IMAGE, name +
                                    ": its images are not of the size in metadata.json (w, h); give them as they "
                                    "were exported, neither turned nor scaled");
  return oneCameraRig(metadata.params, color, depth, name);
}

}  // namespace

bool isRecord3d(const fs::path &folder) {
  const bool is_unpacked = fs::exists(folder / "metadata") && fs::is_directory(folder / "rgbd");
  return is_unpacked || (fs::exists(metadataFile(folder)) && fs::is_directory(imagesFolder(folder) / "rgb") &&
                         fs::is_directory(imagesFolder(folder) / "depth"));
}

Recording openRecord3d(const fs::path &folder) {
  if (fs::is_directory(folder / "rgbd"))
    throw Failure(SPHC_E_UNSUPPORTED, shortPath(folder.string()) +
                                          ": is an unpacked .r3d, whose depth is compressed by LZFSE, which is not "
                                          "read; export \"EXR + RGB\" in the app");
  const Record3dMetadata metadata = metadataOf(folder);
  Recording recording;
  recording.layout = Layout::kRecord3d;
  recording.path = imagesFolder(folder);
  recording.is_by_frame = true;
  recording.images = [path = recording.path] { return std::make_unique<Record3dImages>(path); };
  addFrames(metadata, recording);
  recording.calibration = rigOfRecord3d(metadata, recording);
  return recording;
}

}  // namespace sphc::recording
