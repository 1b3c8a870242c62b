#include "recording_writer.h"

#include <memory>

#include "failure.h"
#include "writer_tum.h"

using namespace sphc::recording;

struct sphc_recording_writer {
  sphc_recording_writer(const char *folder, const sphc_rig &calibration) : writer(folder, calibration) {}

  TumWriter writer;
  bool is_broken = false;  // a list may end in half a line: no more lines
};

namespace {

// Runs one append; after a failure to write, the recording is closed to further ones.
template <typename Body>
sphc_status append(sphc_recording_writer *writer, sphc_message *message, Body &&body) {
  const sphc_status status = guarded(message, [&]() -> sphc_status {
    if (!writer) throw Failure(SPHC_E_ARGUMENT, "writer is null; create one");
    if (writer->is_broken)
      throw Failure(SPHC_E_STATE, "an earlier write failed, and the recording stays unfinished; begin another");
    body(writer->writer);
    return SPHC_OK;
  });
  if (status == SPHC_E_DEVICE) writer->is_broken = true;
  return status;
}

}  // namespace

extern "C" {

sphc_status sphc_recording_create(const char *folder, const sphc_rig *rig, sphc_recording_writer **writer,
                                  sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!folder || !writer) throw Failure(SPHC_E_ARGUMENT, "folder or writer is null; give both");
    const sphc_status status = sphc_rig_check(rig, message);
    if (status < 0) return status;
    *writer = std::make_unique<sphc_recording_writer>(folder, *rig).release();
    return SPHC_OK;
  });
}

sphc_status sphc_recording_add(sphc_recording_writer *writer, const sphc_capture *capture, sphc_message *message) {
  return append(writer, message, [&](TumWriter &out) {
    if (!capture) throw Failure(SPHC_E_ARGUMENT, "capture is null; give one");
    if (capture->struct_size != sizeof *capture)
      throw Failure(SPHC_E_STRUCT_SIZE, "capture.struct_size; set it to sizeof(sphc_capture)");
    out.add(capture->stream, capture->time_ns, capture->image);
  });
}

sphc_status sphc_recording_add_frame(sphc_recording_writer *writer, const sphc_localizer_frame *frame,
                                     sphc_message *message) {
  return append(writer, message, [&](TumWriter &out) {
    if (!frame) throw Failure(SPHC_E_ARGUMENT, "frame is null; give one");
    if (frame->struct_size != sizeof *frame)
      throw Failure(SPHC_E_STRUCT_SIZE, "frame.struct_size; set it to sizeof(sphc_localizer_frame)");
    out.addFrame(*frame);
  });
}

sphc_status sphc_recording_add_pose(sphc_recording_writer *writer, int64_t time_ns,
                                    const sphc_rigid *world_from_camera, sphc_message *message) {
  return append(writer, message, [&](TumWriter &out) {
    if (!world_from_camera) throw Failure(SPHC_E_ARGUMENT, "world_from_camera is null; give one");
    out.addPose(time_ns, *world_from_camera);
  });
}

sphc_status sphc_recording_close(sphc_recording_writer **writer, sphc_message *message) {
  if (!writer || !*writer) return SPHC_OK;
  const sphc_status status = append(*writer, message, [](TumWriter &out) { out.finish(); });
  sphc_recording_abandon(writer);
  return status;
}

void sphc_recording_abandon(sphc_recording_writer **writer) {
  if (!writer) return;
  delete *writer;
  *writer = nullptr;
}

}  // extern "C"
