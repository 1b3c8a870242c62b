// Recordings of k4arecorder and of what writes as it does: Matroska with a track each of colour, depth and
// infrared, and the device's raw calibration attached.
#include <charconv>

#include "host/cameras/azure_kinect.h"
#include "host/cameras/join.h"
#include "host/recording/calibration_json.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/kinect_accelerations.h"
#include "host/recording/foreign/kinect_images.h"
#include "host/recording/foreign/matroska.h"
#include "host/recording/foreign/time_order.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr const char *kCodec = "V_MS/VFW/FOURCC", *kInertialCodec = "S_K4A/IMU";
constexpr size_t kMostCalibrationBytes = 1 << 20;

const MatroskaTrack *findTrack(const MatroskaFile &file, const char *name) {
  for (const auto &[number, track] : file.tracks)
    if (track.name == name) return &track;
  return nullptr;
}

const MatroskaTrack &trackOf(const MatroskaFile &file, const char *name, const char *option,
                             const std::string &recording_name) {
  const MatroskaTrack *track = findTrack(file, name);
  if (!track)
    throw Failure(SPHC_E_UNSUPPORTED,
                  recording_name + ": a Matroska file without a track " + name +
                      ", which is no recording of an Azure Kinect with colour and depth; record "
                      "with " +
                      option);
  if (track->is_encoded || track->codec != kCodec)
    throw Failure(SPHC_E_UNSUPPORTED, recording_name + ": its track " + name +
                                          " was encoded again; give the file as k4arecorder wrote it");
  return *track;
}

KinectColor colorOf(const MatroskaTrack &track, const std::string &recording_name) {
  if (track.fourcc == "MJPG") return KinectColor::kMjpg;
  if (track.fourcc == "NV12") return KinectColor::kNv12;
  if (track.fourcc == "YUY2") return KinectColor::kYuy2;
  if (track.fourcc == "BGRA") return KinectColor::kBgra;
  throw Failure(SPHC_E_UNSUPPORTED, recording_name + ": colour is not MJPG, NV12, YUY2 or BGRA; record with " +
                                        "\"k4arecorder -c 1080p\"");
}

// Blocks count from the first one; the tag says when that was by the device's clock.
int64_t startOf(const MatroskaFile &file) {
  const auto tag = file.tags.find("K4A_START_OFFSET_NS");
  int64_t start_ns = 0;
  if (tag != file.tags.end())
    std::from_chars(tag->second.data(), tag->second.data() + tag->second.size(), start_ns);
  return std::clamp<int64_t>(start_ns, 0, INT64_MAX / 4);
}

std::vector<RecordedImage> imagesOf(const MatroskaTrack &track, int64_t start_ns, Recording *recording) {
  std::vector<RecordedImage> images;
  images.reserve(track.blocks.size());
  for (const MatroskaBlock &block : track.blocks) {
    recording->lost_count += block.frame_count > 1;
    if (block.frame_count > 1) continue;
    RecordedImage image = {};
    image.time_ns = start_ns + block.time_ns;
    image.place = {Kind::kNone, 0, block.start, block.bytes};
    images.push_back(std::move(image));
  }
  return inOrderOfTime(std::move(images), recording);
}

// Infrared is what comes back of the sensor's own light, taken with the depth image of the same time.
void addAmplitudes(const MatroskaFile &file, const MatroskaTrack &depth_track, Recording *recording) {
  const MatroskaTrack *track = findTrack(file, "IR");
  if (!track || track->is_encoded || track->width != depth_track.width || track->height != depth_track.height)
    return;
  Recording ignored;
  const std::vector<RecordedImage> infrared = imagesOf(*track, startOf(file), &ignored);
  size_t next = 0;
  for (RecordedImage &depth : recording->depth) {
    while (next < infrared.size() && infrared[next].time_ns < depth.time_ns) ++next;
    if (next == infrared.size() || infrared[next].time_ns != depth.time_ns) continue;
    depth.amplitude = infrared[next].place;
    depth.amplitude.kind = Kind::kAmplitudeImage;
  }
}

std::optional<sphc_rigid> colorFromAccelerometer(const host::TextFile &calibration) {
  const std::optional<sphc_rigid> sensor_from_rig = host::readAzureKinectAccelerometer(calibration);
  if (!sensor_from_rig) return {};
  for (const host::NamedCamera &camera : host::readAzureKinect(calibration).cameras)
    if (camera.name == "color") {
      sphc_rigid rig_from_sensor, color_from_sensor;
      sphc_rigid_inverse(&*sensor_from_rig, &rig_from_sensor);
      sphc_rigid_compose(&*camera.camera_from_rig, &rig_from_sensor, &color_from_sensor);
      return color_from_sensor;
    }
  return {};
}

std::string calibrationText(const fs::path &path, const MatroskaFile &file) {
  const auto named = file.tags.find("K4A_CALIBRATION_FILE");
  const auto attached =
      file.attachments.find(named == file.tags.end() ? std::string("calibration.json") : named->second);
  if (attached == file.attachments.end())
    throw Failure(SPHC_E_ARGUMENT, "no calibration.json is attached; give a calibration file");
  const uint64_t bytes = attached->second.end - attached->second.start;
  if (bytes > kMostCalibrationBytes)
    throw Failure(SPHC_E_ARGUMENT, "its calibration.json is over 1 MiB; give a calibration file");
  std::string text(bytes, '\0');
  File(path).read(attached->second.start, reinterpret_cast<uint8_t *>(text.data()), text.size());
  return text;
}

// Of a recording that tells how its accelerometer stands against the colour camera.
void addAccelerations(const MatroskaFile &file, Recording *recording) {
  const MatroskaTrack *track = findTrack(file, "IMU");
  if (!track || track->is_encoded || track->codec != kInertialCodec) return;
  std::optional<sphc_rigid> color_from_sensor;
  try {
    color_from_sensor = colorFromAccelerometer({"calibration.json", calibrationText(recording->path, file)});
  } catch (const std::runtime_error &) {  // then there are none
  }
  if (!color_from_sensor) return;
  recording->accelerations =
      kinectAccelerations(recording->path, *track, startOf(file), &recording->bad_acceleration_count);
  turnAccelerations(*color_from_sensor, &recording->accelerations);
}

sphc_rig rigOfKinect(const fs::path &path, const MatroskaFile &file, host::ImageSize color, host::ImageSize depth) {
  const host::CalibrationPart part = host::readAzureKinect({"calibration.json", calibrationText(path, file)});
  for (const host::NamedCamera &camera : part.cameras)
    if (!camera.inexact.empty())
      throw Failure(SPHC_E_ARGUMENT, "camera " + camera.name + ": " + camera.inexact +
                                         "; take calibration.json out (\"mkvextract attachments\"), convert it by "
                                         "\"spherecloud calibration --approximate\" and give that");
  host::JoinOptions options;
  options.color_size = color;
  options.depth_size = depth;
  options.depth_unit_m = 0.001;
  return requireGood(host::joinParts({part}, options));
}

}  // namespace

bool isMatroska(const fs::path &file) { return beginsWith(file, kMatroskaMagic); }

Recording openAzureKinect(const fs::path &path) {
  const MatroskaFile file = readMatroska(path);
  const std::string name = shortPath(path.string());
  const MatroskaTrack &color = trackOf(file, "COLOR", "\"k4arecorder -c 1080p\"", name);
  const MatroskaTrack &depth = trackOf(file, "DEPTH", "\"k4arecorder -d NFOV_UNBINNED\"", name);
  const host::ImageSize color_size = {color.width, color.height}, depth_size = {depth.width, depth.height};
  const KinectColor coding = colorOf(color, name);
  Recording recording;
  recording.layout = Layout::kAzureKinect;
  recording.path = path;
  recording.lost_count = file.lost_count;
  recording.is_cut = file.is_cut;
  const int64_t start_ns = startOf(file);
  recording.color = imagesOf(color, start_ns, &recording);
  recording.depth = imagesOf(depth, start_ns, &recording);
  for (const auto &[images, track] : {std::pair(&recording.color, "COLOR"), std::pair(&recording.depth, "DEPTH")})
    if (images->empty())
      throw Failure(SPHC_E_DEVICE, name + ": its track " + track + " has no images; copy the file again");
  addAmplitudes(file, depth, &recording);
  addAccelerations(file, &recording);
  recording.images = [path, coding, color_size, depth_size] {
    return std::make_unique<KinectImages>(path, coding, color_size, depth_size);
  };
  try {
    recording.calibration = rigOfKinect(path, file, color_size, depth_size);
  } catch (const std::runtime_error &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = name + ": " + failure.what();
  }
  return recording;
}

}  // namespace sphc::recording
