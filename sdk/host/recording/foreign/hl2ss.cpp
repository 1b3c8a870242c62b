// Recordings of a HoloLens 2 in research mode, by hl2ss: colour and depth ("Long Throw").
#include <cmath>

#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/camera_axes.h"
#include "host/recording/foreign/comma_text.h"
#include "host/recording/foreign/hl2ss_images.h"
#include "host/recording/foreign/hololens_rig.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr const char *kColorFile = "personal_video.bin", *kDepthFile = "rm_depth_longthrow.bin";
constexpr const char *kDepthFolder = "rm_depth_longthrow";
constexpr size_t kMostTableBytes = size_t{1} << 24;

std::shared_ptr<const Hl2ssStream> streamIn(const fs::path &folder, const char *name, uint16_t port,
                                            const char *stream) {
  const fs::path path = folder / name;
  if (!fs::exists(path))
    throw Failure(SPHC_E_DEVICE, shortPath(folder.string()) + ": no " + name + "; record " + stream + " too");
  auto made = std::make_shared<Hl2ssStream>(Hl2ssStream{path, readHl2ss(path)});
  if (made->file.port != port)
    throw Failure(SPHC_E_DEVICE, shortPath(path.string()) +
                                     ": holds another stream than its name says; give each "
                                     "file the name it was recorded by");
  return made;
}

bool isLater(const std::vector<RecordedImage> &images, int64_t time_ns) {
  return images.empty() || time_ns > images.back().time_ns;
}

RecordedImage imageOf(const Hl2ssPacket &packet, size_t number) {
  RecordedImage image = {};
  image.time_ns = packet.time_ns;
  image.sequence = static_cast<uint32_t>(number);
  return image;
}

// Adds images and poses; returns the camera, of which the lens makes another with each image: the median.
sphc_camera addColor(const Hl2ssStream &color, Recording &recording) {
  const File file(color.path);
  std::vector<double> params[4];
  for (size_t i = 0; i < color.file.packets.size(); ++i) {
    const Hl2ssPacket &packet = color.file.packets[i];
    const bool is_whole = packet.bytes >= kHl2ssColorTail;
    const Hl2ssColorTail tail = is_whole ? hl2ssColorTail(file, packet) : Hl2ssColorTail{};
    if (tail.width != color.file.width || tail.height != color.file.height) {
      ++recording.lost_count;
      continue;
    }
    if (!isLater(recording.color, packet.time_ns)) {
      ++recording.backward_count;
      continue;
    }
    recording.color.push_back(imageOf(packet, i));
    for (size_t each = 0; each < 4; ++each)
      if (std::isfinite(tail.params[each])) params[each].push_back(static_cast<double>(tail.params[each]));
    if (packet.pose)
      recording.poses.add(packet.time_ns, fromUpBackAxes(*packet.pose));
    else
      ++recording.bad_pose_count;
  }
  sphc_camera camera = {SPHC_CAMERA_PINHOLE, color.file.width, color.file.height, 4, {}};
  for (size_t each = 0; each < 4; ++each)
    if (!params[each].empty()) camera.params[each] = medianOf(params[each]);
  return camera;
}

// Adds images; returns where the rig was, in the world of colour.
PoseTrack addDepth(const Hl2ssStream &depth, Recording &recording) {
  PoseTrack world_from_rig;
  for (size_t i = 0; i < depth.file.packets.size(); ++i) {
    const Hl2ssPacket &packet = depth.file.packets[i];
    if (!isLater(recording.depth, packet.time_ns)) {
      ++recording.backward_count;
      continue;
    }
    recording.depth.push_back(imageOf(packet, i));
    if (packet.pose) world_from_rig.add(packet.time_ns, *packet.pose);
  }
  return world_from_rig;
}

// In the recording or in its folder "calibration"; a recording of hl2ss has none until it is copied there.
fs::path calibrationFolder(const fs::path &folder) {
  for (const fs::path &each : {folder / kDepthFolder, folder / "calibration" / kDepthFolder})
    if (fs::exists(each / "uv2xy.bin")) return each;
  throw Failure(SPHC_E_ARGUMENT, shortPath(folder.string()) + ": no " + kDepthFolder +
                                     "/uv2xy.bin, which has the rays of the depth camera; copy the folder " +
                                     kDepthFolder +
                                     " into it that hl2ss_3dcv.get_calibration_rm leaves of this headset");
}

Bytes tableIn(const fs::path &file, size_t least_bytes) {
  Bytes bytes;
  try {
    readFile(file, kMostTableBytes, bytes);
    if (bytes.size() < least_bytes) throw Failure(SPHC_E_ARGUMENT, "is too short; copy it again");
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath(file.string()) + ": " + failure.what());
  }
  return bytes;
}

std::shared_ptr<const DepthLut> lutIn(const fs::path &folder) {
  const fs::path file = folder / "uv2xy.bin";
  const Bytes bytes = tableIn(file, 0);
  try {
    return std::make_shared<const DepthLut>(
        DepthLut::ofPlanePoints(viewOf(bytes), {kLongThrowWidth, kLongThrowHeight}));
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath(file.string()) + ": " + failure.what());
  }
}

sphc_rig rigOf(const fs::path &calibration, const sphc_camera &color, const sphc_camera &depth,
               const PoseTrack &world_from_color, const PoseTrack &world_from_rig) {
  const fs::path extrinsics = calibration / "extrinsics.bin", scale = calibration / "scale.bin";
  const std::optional<sphc_rigid> depth_from_rig = hl2ssRigidFrom(tableIn(extrinsics, kHl2ssMatrixBytes).data());
  if (!depth_from_rig)
    throw Failure(SPHC_E_ARGUMENT, shortPath(extrinsics.string()) + ": is no rigid transform; copy it again");
  float units_per_m = 0;
  std::memcpy(&units_per_m, tableIn(scale, sizeof units_per_m).data(), sizeof units_per_m);
  if (units_per_m != 1000)
    throw Failure(SPHC_E_UNSUPPORTED,
                  shortPath(scale.string()) + ": depth is not in millimetres; give a calibration file");
  return rigOfHoloLens(color, depth, world_from_color, world_from_rig, *depth_from_rig);
}

}  // namespace

bool isHl2ss(const fs::path &folder) { return fs::exists(folder / kColorFile) || fs::exists(folder / kDepthFile); }

Recording openHl2ss(const fs::path &folder) {
  const auto color = streamIn(folder, kColorFile, kHl2ssVideoPort, "PERSONAL_VIDEO");
  const auto depth = streamIn(folder, kDepthFile, kHl2ssLongThrowPort, "RM_DEPTH_LONGTHROW");
  Recording recording;
  recording.layout = Layout::kHl2ss;
  recording.path = folder;
  recording.is_cut = color->file.is_cut || depth->file.is_cut;
  const sphc_camera color_camera = addColor(*color, recording);
  const PoseTrack world_from_rig = addDepth(*depth, recording);
  for (const auto &[images, stream] : {std::pair(&recording.color, color), std::pair(&recording.depth, depth)})
    if (images->empty())
      throw Failure(SPHC_E_DEVICE, shortPath(stream->path.string()) +
                                       ": has no whole image of the size it says, or another version of hl2ss "
                                       "wrote it; copy it again");
  const fs::path calibration = calibrationFolder(folder);
  const std::shared_ptr<const DepthLut> lut = lutIn(calibration);
  recording.images = [color, depth, lut] { return std::make_unique<Hl2ssImages>(color, depth, lut); };
  try {
    recording.calibration = rigOf(calibration, color_camera, lut->camera(), recording.poses, world_from_rig);
  } catch (const Failure &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = shortPath(folder.string()) + ": " + failure.what();
  }
  return recording;
}

}  // namespace sphc::recording
