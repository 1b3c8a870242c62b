#include "writer_raw.h"

#include <zlib.h>

#include <utility>

#include "calibration_json.h"
#include "failure.h"
#include "pixels.h"
#include "pose_track.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMagic = "SPHC-RAW";
constexpr uint32_t kVersion = 1;

void putDouble(Bytes &out, double value) {
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  putLittle(out, bits);
}

void putCamera(Bytes &out, const sphc_camera &camera) {
  putLittle(out, static_cast<uint32_t>(camera.model));
  putLittle(out, camera.width);
  putLittle(out, camera.height);
  putLittle(out, camera.param_count);
  for (const double param : camera.params) putDouble(out, param);
}

void putRigid(Bytes &out, const sphc_rigid &rigid) {
  for (const double q : rigid.q_wxyz) putDouble(out, q);
  for (const double t : rigid.t_m) putDouble(out, t);
}

void putCrc(Bytes &out) { putLittle(out, static_cast<uint32_t>(crc32_z(0, out.data(), out.size()))); }

fs::path unfinishedName(const fs::path &path) {
  if (fs::exists(path))
    throw Failure(SPHC_E_STATE, shortPath(path.string()) + ": is there already; give a new name");
  return path.string() + ".unfinished";
}

}  // namespace

RawWriter::RawWriter(const fs::path &path, fs::path unfinished, const sphc_rig &calibration,
                     sphc_format color_format)
    : path_(path),
      unfinished_(std::move(unfinished)),
      calibration_(requireGood(calibration)),
      color_format_(color_format),
      file_(File::create(unfinished_)) {}

// Delegates, so that the destructor removes the file when its first bytes cannot be written.
RawWriter::RawWriter(const fs::path &path, const sphc_rig &calibration, sphc_format color_format)
    : RawWriter(path, unfinishedName(path), calibration, color_format) {
  file_.append({viewOf(header())});
}

RawWriter::~RawWriter() {
  std::error_code ignored;
  if (!is_finished_) fs::remove(unfinished_, ignored);
}

Bytes RawWriter::header() const {
  Bytes out;
  append(out, kMagic.data(), kMagic.size());
  putLittle(out, kVersion);
  putLittle(out, frame_count_);
  putLittle(out, static_cast<uint32_t>(color_format_));
  putLittle(out, uint32_t{0});
  putCamera(out, calibration_.color_camera);
  putCamera(out, calibration_.depth_camera);
  putRigid(out, calibration_.color_from_depth);
  putDouble(out, calibration_.depth_unit_m);
  putLittle(out, uint32_t{0});
  putCrc(out);
  return out;
}

void RawWriter::add(const sphc_localizer_frame &frame, const sphc_rigid *world_from_camera) {
  checkImage(frame.color, calibration_.color_camera, true);
  checkImage(frame.depth, calibration_.depth_camera, false);
  if (frame.color.format != color_format_) throw Failure(SPHC_E_IMAGE, "colour image: all must have one format");
  depth_.resize(packedBytes(frame.depth));
  color_.resize(packedBytes(frame.color));
  packPixels(frame.depth, SPHC_FORMAT_DEPTH16, depth_.data());
  packPixels(frame.color, color_format_, color_.data());
  const uLong depth_crc = crc32_z(0, depth_.data(), depth_.size());
  head_.clear();
  putLittle(head_, frame.sequence);
  putLittle(head_, uint32_t{world_from_camera != nullptr});
  putLittle(head_, static_cast<uint64_t>(frame.color_time_ns));
  putLittle(head_, static_cast<uint64_t>(frame.depth_time_ns));
  putRigid(head_, world_from_camera ? checkedPose(*world_from_camera) : sphc_rigid{});
  putLittle(head_, static_cast<uint32_t>(crc32_z(depth_crc, color_.data(), color_.size())));
  putCrc(head_);
  file_.append({viewOf(head_), viewOf(depth_), viewOf(color_)});
  ++frame_count_;
}

void RawWriter::finish() {
  file_.writeAt(0, viewOf(header()));
  file_.sync();
  if (fs::exists(path_))
    throw Failure(SPHC_E_STATE, shortPath(path_.string()) + ": came to be meanwhile; remove it");
  fs::rename(unfinished_, path_);
  is_finished_ = true;
  File::syncFolder(path_);
}

}  // namespace sphc::recording
