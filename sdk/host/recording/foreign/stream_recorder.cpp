// Recordings of a HoloLens 2 in research mode, by the sample StreamRecorder: colour and "Depth Long Throw".
#include <algorithm>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/comma_text.h"
#include "host/recording/foreign/depth_lut.h"
#include "host/recording/foreign/hololens_rig.h"
#include "host/recording/foreign/opaque_pixels.h"
#include "host/recording/foreign/pgm.h"
#include "host/recording/foreign/stream_recorder_text.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostHoloLensBytes = size_t{1} << 28;
constexpr const char *kSensor = "Depth Long Throw";

template <typename Parse>
auto parsedText(const fs::path &file, Parse &&parse) {
  const std::string text = readText(file);
  return inFile(file, [&] { return parse(text); });
}

class HoloLensImages : public LayoutImages {
 public:
  HoloLensImages(fs::path folder, std::shared_ptr<const DepthLut> lut)
      : folder_(std::move(folder)), lut_(std::move(lut)) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override {
    readFile(folder_ / image.file, kMostHoloLensBytes, encoded_);
    if (stream == SPHC_STREAM_DEPTH)
      readDepth(camera, reinterpret_cast<uint16_t *>(pixels));
    else if (fs::path(image.file).extension() == ".bytes")
      readBytes(camera, format, pixels);
    else
      decodeImage(viewOf(encoded_), ImageType::kPng, camera, format, pixels);
  }

 private:
  void readDepth(const sphc_camera &camera, uint16_t *depth_mm) {
    const ImageSize size = pgmSizeOf(viewOf(encoded_));
    requireSize(size.width, size.height, lut_->camera(), false);
    requireSize(size.width, size.height, camera, false);
    range_mm_.resize(size_t{size.width} * size.height);
    decodePgm(viewOf(encoded_), range_mm_.data());
    lut_->toPinhole(range_mm_, depth_mm);
  }
  void readBytes(const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
    if (encoded_.size() != size_t{camera.width} * camera.height * 4)
      throw Failure(SPHC_E_IMAGE,
                    "is not four bytes for each pixel of the calibration's color_camera; copy it again");
    packOpaque(encoded_.data(), camera.width, camera.height, camera.width * 4, SPHC_FORMAT_BGR8, format, pixels);
  }

  fs::path folder_;
  std::shared_ptr<const DepthLut> lut_;
  Bytes encoded_;
  std::vector<uint16_t> range_mm_;
};

fs::path pvFileIn(const fs::path &folder) {
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > 6 && name.substr(name.size() - 6) == "pv.txt") return entry.path();
  }
  throw Failure(SPHC_E_DEVICE, shortPath(folder.string()) + ": no *_pv.txt, the colour camera's; record PV too");
}

// "PV/132697151403874938.png", as the sample's own scripts leave it, or .bytes; empty without one.
std::string pvImage(const fs::path &folder, const std::string &name) {
  for (const char *ending : {".png", ".bytes"}) {
    const std::string file = "PV/" + name + ending;
    if (fs::exists(folder / file)) return file;
  }
  return "";
}

void addColor(const PvFile &pv, Recording &recording) {
  for (size_t i = 0; i < pv.frames.size(); ++i) {
    const PvFrame &frame = pv.frames[i];
    const std::string file = pvImage(recording.path, frame.name);
    if (!file.empty()) recording.color.push_back({frame.time_ns, static_cast<uint32_t>(i), file});
    if (frame.world_from_camera)
      recording.poses.add(frame.time_ns, *frame.world_from_camera);
    else
      ++recording.bad_pose_count;
  }
}

void addDepth(Recording &recording) {
  const fs::path folder = recording.path / kSensor;
  if (fs::is_directory(folder))
    for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
      int64_t time_ns = 0;  // not in the names of the infrared images, "132697151403874938_ab.pgm"
      if (entry.path().extension() == ".pgm" && parseTicks(entry.path().stem().string(), time_ns))
        recording.depth.push_back({time_ns, 0, kSensor + ("/" + entry.path().filename().string())});
    }
  std::sort(recording.depth.begin(), recording.depth.end(),
            [](const RecordedImage &a, const RecordedImage &b) { return a.time_ns < b.time_ns; });
  for (size_t i = 0; i < recording.depth.size(); ++i) recording.depth[i].sequence = static_cast<uint32_t>(i);
}

std::shared_ptr<const DepthLut> lutOf(const Recording &recording) {
  const fs::path image = recording.path / recording.depth.front().file;
  const fs::path table = recording.path / (kSensor + std::string("_lut.bin"));
  Bytes bytes;
  const ImageSize size = inFile(image, [&] {
    readFile(image, kMostHoloLensBytes, bytes);
    return pgmSizeOf(viewOf(bytes));
  });
  return inFile(table, [&] {
    readFile(table, kMostHoloLensBytes, bytes);
    return std::make_shared<const DepthLut>(DepthLut::ofRays(viewOf(bytes), size));
  });
}

sphc_rig rigOf(const PvFile &pv, const DepthLut &lut, const Recording &recording) {
  const std::string sensor = kSensor;
  const PoseTrack rig_track = parsedText(recording.path / (sensor + "_rig2world.txt"), rigTrackFrom);
  const sphc_rigid depth_from_rig = parsedText(recording.path / (sensor + "_extrinsics.txt"), sensorFromRigFrom);
  const sphc_camera color = {
      SPHC_CAMERA_PINHOLE, pv.width, pv.height, 4, {pv.params[0], pv.params[1], pv.params[2], pv.params[3]}};
  return rigOfHoloLens(color, lut.camera(), recording.poses, rig_track, depth_from_rig);
}

}  // namespace

bool isStreamRecorder(const fs::path &folder) { return fs::exists(folder / (kSensor + std::string("_lut.bin"))); }

Recording openStreamRecorder(const fs::path &folder) {
  Recording recording;
  recording.layout = Layout::kStreamRecorder;
  recording.path = folder;
  const PvFile pv = parsedText(pvFileIn(folder), pvFileFrom);
  addColor(pv, recording);
  addDepth(recording);
  const std::string name = shortPath(folder.string());
  for (const auto &[images, where] : {std::pair(&recording.color, "PV"), std::pair(&recording.depth, kSensor)})
    if (images->empty())
      throw Failure(SPHC_E_DEVICE, name + ": no images in the folder \"" + where + "\"; unpack " + where +
                                       ".tar into a folder of that name");
  const std::shared_ptr<const DepthLut> lut = lutOf(recording);
  recording.images = [folder, lut] { return std::make_unique<HoloLensImages>(folder, lut); };
  try {
    recording.calibration = rigOf(pv, *lut, recording);
  } catch (const Failure &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = name + ": " + failure.what();
  }
  return recording;
}

}  // namespace sphc::recording
