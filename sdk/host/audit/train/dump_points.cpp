// dump_points RECORDING OUT: the private points of a recording that may be trained on.
// OUT, little-endian: uint32 count, count times float32 x, y, z in metres of the recording's world, count times 128
// bytes.
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "host/audit/train/output.h"
#include "host/frames/recording.h"
#include "host/import/rgbd_import.h"

namespace sphc::host {
namespace {

PointModel pointsOf(const char *recording) {
  RecordingOptions options;
  options.folder = recording;
  RgbdImportSummary summary;
  return importRgbd(openReplay(options).get(), {}, {}, &summary);
}

void write(const PointModel &model, const char *path) {
  std::ofstream out(path, std::ios::binary);
  writeValue(static_cast<uint32_t>(model.points.size()), &out);
  for (const ModelPoint &point : model.points) {
    for (int axis = 0; axis < 3; ++axis) writeValue(static_cast<float>(point.position_m[axis]), &out);
  }
  for (const ModelPoint &point : model.points) writeValue(point.descriptor, &out);
  if (!out.flush()) throw std::runtime_error(std::string(path) + " cannot be written; is the disk full?");
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  if (argc != 3) {
    std::cerr << "usage: dump_points RECORDING OUT\n";
    return 2;
  }
  try {
    sphc::host::write(sphc::host::pointsOf(argv[1]), argv[2]);
  } catch (const std::exception &failure) {
    std::cerr << "dump_points: " << failure.what() << '\n';
    return 1;
  }
  return 0;
}
