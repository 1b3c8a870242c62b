#include "writer_raw.h"

#include <utility>

#include "failure.h"
#include "pose_track.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

// What the writer of devices says goes into memory first: a frame is in the file whole or not at all.
int gather(void *user, uint64_t /*offset*/, const void *bytes, size_t count) {
  append(*static_cast<Bytes *>(user), bytes, count);
  return 0;
}

void require(sphc_status status, const sphc_message &message) {
  if (status != SPHC_OK) throw Failure(status, message.text);
}

fs::path unfinishedName(const fs::path &path) {
  if (fs::exists(path))
    throw Failure(SPHC_E_STATE, shortPath(path.string()) + ": is there already; give a new name");
  const std::string unfinished = path.string() + ".unfinished";
  if (fs::exists(unfinished))
    throw Failure(SPHC_E_STATE, shortPath(unfinished) +
                                    ": is there, which a killed program left or another one writes; remove it, or "
                                    "give another name");
  return unfinished;
}

}  // namespace

RawWriter::RawWriter(const fs::path &path, fs::path unfinished)
    : path_(path), unfinished_(std::move(unfinished)), file_(File::create(unfinished_)) {}

// Delegates, so that the destructor removes the file when its first bytes cannot be written.
RawWriter::RawWriter(const fs::path &path, const sphc_rig &calibration, sphc_format color_format)
    : RawWriter(path, unfinishedName(path)) {
  sphc_message message = {};
  require(sphc_raw_writer_begin(&writer_, gather, &bytes_, &calibration, color_format, &message), message);
  file_.append({viewOf(bytes_)});
}

RawWriter::~RawWriter() {
  std::error_code ignored;
  if (!is_finished_) fs::remove(unfinished_, ignored);
}

void RawWriter::add(const sphc_localizer_frame &frame, const sphc_rigid *world_from_camera) {
  sphc_rigid pose;
  if (world_from_camera) pose = checkedPose(*world_from_camera);
  bytes_.clear();
  bytes_.reserve(writer_.frame_bytes);
  sphc_raw_writer next = writer_;
  sphc_message message = {};
  require(sphc_raw_writer_add(&next, &frame, world_from_camera ? &pose : nullptr, &message), message);
  file_.append({viewOf(bytes_)});
  writer_ = next;
}

void RawWriter::finish() {
  bytes_.clear();
  sphc_message message = {};
  require(sphc_raw_writer_finish(&writer_, &message), message);
  file_.writeAt(0, viewOf(bytes_));
  file_.sync();
  if (fs::exists(path_))
    throw Failure(SPHC_E_STATE, shortPath(path_.string()) + ": came to be meanwhile; remove it");
  fs::rename(unfinished_, path_);
  is_finished_ = true;
  File::syncFolder(path_);
}

}  // namespace sphc::recording
