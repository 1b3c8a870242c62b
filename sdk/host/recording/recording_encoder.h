// Captures in, a crash-safe file out: the recorder without its queue.
#pragma once

#include "encoded_image.h"
#include "host/recording/mcap/depth_zstd.h"
#include "host/recording/mcap/writer.h"
#include "recorder.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::recording {

class RecordingEncoder {
 public:
  // Makes the file, its head with the calibration, and all memory.  Throws Failure, as all of these do.
  RecordingEncoder(const std::filesystem::path &path, const sphc_rig &calibration,
                   const sphc_recorder_config &config);

  // The image is packed and was checked; `amplitude` likewise, GRAY16, or zero.
  void add(const CaptureNote &note, const sphc_image &image, const sphc_image &amplitude);
  void addPose(uint32_t sequence, int64_t time_ns, const sphc_rigid &world_from_camera);
  void addAcceleration(const TimedAcceleration &acceleration);
  void addDrop(const Drop &drop, int64_t log_time_ns);

  // Everything added is in the file.
  bool isWritten() const { return writer_.chunkIsEmpty(); }
  // Makes it so, and brings the file to the disk.
  void sync();
  void finish(const sphc_recorder_statistics &statistics);
  uint64_t fileBytes() const { return writer_.bytesWritten(); }

 private:
  Kind kindOf(sphc_stream stream) const;
  Kind amplitudeKind() const;
  void putEncoded(Kind kind, int64_t time_ns, const sphc_image &image, Bytes &out);
  ByteView encodeDepth(Kind kind, const sphc_image &image);

  sphc_recorder_config config_;
  McapWriter writer_;
  DepthZstdEncoder zstd_;
  ImageEncoder jpeg_;
  Bytes depth_;  // encoded
  bool is_synced_ = true;
};

}  // namespace sphc::recording
