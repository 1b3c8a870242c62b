// Writes the layout of the 7-Scenes data set.
#include <cstdio>
#include <filesystem>

#include "encoded_image.h"
#include "failure.h"
#include "file_writer.h"
#include "pose_track.h"
#include "recording_writer.h"
#include "text_field.h"

using namespace sphc::replay;
namespace fs = std::filesystem;

namespace {

fs::path frameFile(const char *folder, uint32_t number, const char *kind) {
  char name[40];
  std::snprintf(name, sizeof name, "frame-%06u.%s", number, kind);
  return fs::path(folder) / name;
}

// Four rows of four.
std::string matrixText(const sphc_rigid &pose) {
  const double w = pose.q_wxyz[0], x = pose.q_wxyz[1], y = pose.q_wxyz[2], z = pose.q_wxyz[3];
  const double *t = pose.t_m;
  return formatNumbers({1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), t[0]}) + "\n" +
         formatNumbers({2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), t[1]}) + "\n" +
         formatNumbers({2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), t[2]}) + "\n0 0 0 1\n";
}

// Of any size.
void checkOwnSize(const sphc_image &image, bool is_color) {
  sphc_camera camera = {};
  camera.width = image.width;
  camera.height = image.height;
  checkImage(image, camera, is_color);
}

void writeImage(const fs::path &path, const sphc_image &image, bool is_color) {
  checkOwnSize(image, is_color);
  ImageEncoder encoder;
  writeFile(path, encoder.png(image));
}

}  // namespace

extern "C" {

sphc_status sphc_recording_write_7scenes(const char *folder, const sphc_frame *frame,
                                         const sphc_rigid *world_from_camera, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!folder || !frame) throw Failure(SPHC_E_ARGUMENT, "folder or frame is null");
    if (frame->struct_size != sizeof *frame) throw Failure(SPHC_E_STRUCT_SIZE, "frame.struct_size");
    if (world_from_camera && !isFinite(*world_from_camera)) throw Failure(SPHC_E_ARGUMENT, "pose: not finite");
    const fs::path color = frameFile(folder, frame->sequence, "color.png");
    if (fs::exists(color)) throw Failure(SPHC_E_STATE, shortPath(color.string()) + ": is there already; remove it");
    checkOwnSize(frame->depth, false);  // before the colour image is written
    writeImage(color, frame->color, true);
    writeImage(frameFile(folder, frame->sequence, "depth.png"), frame->depth, false);
    if (!world_from_camera) return SPHC_OK;
    const std::string text = matrixText(*world_from_camera);
    writeFile(frameFile(folder, frame->sequence, "pose.txt"),
              {reinterpret_cast<const uint8_t *>(text.data()), text.size()});
    return SPHC_OK;
  });
}

}  // extern "C"
