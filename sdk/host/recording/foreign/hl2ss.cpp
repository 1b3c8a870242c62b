// Recordings of a HoloLens 2 in research mode, by hl2ss: colour and depth ("Long Throw").
#include <cmath>

#include "host/base/median.h"
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

std::vector<Hl2ssColorTail> tailsOf(const Hl2ssStream &color) {
  const File file(color.path);
  std::vector<Hl2ssColorTail> tails;
  for (const Hl2ssPacket &packet : color.file.packets)
    tails.push_back(packet.bytes > kHl2ssColorTail ? hl2ssColorTail(file, packet) : Hl2ssColorTail{});
  return tails;
}

// Of the first image: the head of the file has what was asked for, which a camera that others use may not give.
ImageSize sizeOf(const std::vector<Hl2ssColorTail> &tails, const fs::path &path) {
  for (const Hl2ssColorTail &tail : tails)
    if (tail.width > 0 && tail.height > 0) return {tail.width, tail.height};
  throw tails.empty() ? Failure(SPHC_E_DEVICE, shortPath(path.string()) + ": has no whole image; copy it again")
                      : Failure(SPHC_E_UNSUPPORTED, shortPath(path.string()) + kHl2ssTooOld);
}

// Adds images and poses; returns the camera: the median, since focusing changes it from image to image.
sphc_camera addColor(const Hl2ssStream &color, Recording &recording) {
  const std::vector<Hl2ssColorTail> tails = tailsOf(color);
  const ImageSize size = sizeOf(tails, color.path);
  std::vector<double> params[4];
  for (size_t i = 0; i < tails.size(); ++i) {
    const Hl2ssPacket &packet = color.file.packets[i];
    if (tails[i].width != size.width || tails[i].height != size.height) {
      ++recording.lost_count;
      continue;
    }
    if (!isLater(recording.color, packet.time_ns)) {
      ++recording.lost_count;
      ++recording.backward_count;
      continue;
    }
    recording.color.push_back(imageOf(packet, i));
    for (size_t each = 0; each < 4; ++each)
      if (std::isfinite(tails[i].params[each])) params[each].push_back(static_cast<double>(tails[i].params[each]));
    if (packet.pose)
      recording.poses.add(packet.time_ns, fromUpBackAxes(*packet.pose));
    else
      ++recording.bad_pose_count;
  }
  sphc_camera camera = {SPHC_CAMERA_PINHOLE, size.width, size.height, 4, {}};
  for (size_t each = 0; each < 4; ++each)
    if (!params[each].empty()) camera.params[each] = host::median(params[each]);
  return camera;
}

// Adds images; returns where the rig was, in the world of colour.
PoseTrack addDepth(const Hl2ssStream &depth, Recording &recording) {
  PoseTrack world_from_rig;
  for (size_t i = 0; i < depth.file.packets.size(); ++i) {
    const Hl2ssPacket &packet = depth.file.packets[i];
    if (!isLater(recording.depth, packet.time_ns)) {
      ++recording.lost_count;
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
                                     "/uv2xy.bin (rays of the depth camera); copy the folder into it that "
                                     "hl2ss_3dcv.get_calibration_rm writes");
}

Bytes tableIn(const fs::path &file, size_t least_bytes) {
  Bytes bytes;
  readFile(file, kMostTableBytes, bytes);
  if (bytes.size() < least_bytes) throw Failure(SPHC_E_ARGUMENT, "is too short; copy it again");
  return bytes;
}

std::shared_ptr<const DepthLut> lutIn(const fs::path &folder) {
  const fs::path file = folder / "uv2xy.bin";
  return inFile(file, [&] {
    return std::make_shared<const DepthLut>(DepthLut::ofPlanePoints(viewOf(tableIn(file, 0)), kLongThrowSize));
  });
}

sphc_rigid depthFromRig(const fs::path &file) {
  return inFile(file, [&] {
    const std::optional<sphc_rigid> rigid = hl2ssRigidFrom(tableIn(file, kHl2ssMatrixBytes).data());
    if (!rigid) throw Failure(SPHC_E_ARGUMENT, "is no rigid transform; copy it again");
    return *rigid;
  });
}

void requireMillimetres(const fs::path &file) {
  inFile(file, [&] {
    float units_per_m = 0;
    std::memcpy(&units_per_m, tableIn(file, sizeof units_per_m).data(), sizeof units_per_m);
    if (units_per_m != 1000)
      throw Failure(SPHC_E_UNSUPPORTED, "says that depth is not in millimetres; give a calibration file");
  });
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
  if (recording.depth.empty())
    throw Failure(SPHC_E_DEVICE, shortPath(depth->path.string()) + ": has no whole image; copy it again");
  const fs::path calibration = calibrationFolder(folder);
  const std::shared_ptr<const DepthLut> lut = lutIn(calibration);
  const ImageSize color_size = {color_camera.width, color_camera.height};
  recording.images = [=] { return std::make_unique<Hl2ssImages>(color, color_size, depth, lut); };
  try {
    const sphc_rigid depth_from_rig = depthFromRig(calibration / "extrinsics.bin");
    requireMillimetres(calibration / "scale.bin");
    recording.calibration = inFile(folder, [&] {
      return rigOfHoloLens(color_camera, lut->camera(), recording.poses, world_from_rig, depth_from_rig);
    });
  } catch (const Failure &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = failure.what();
  }
  return recording;
}

}  // namespace sphc::recording
