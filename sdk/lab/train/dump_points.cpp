// dump_points RECORDING OUT: the private points of a recording that may be trained on.  OUT as point_file.h says,
// in metres of the recording's world.
#include <fstream>
#include <stdexcept>
#include <string>

#include "host/frames/recording.h"
#include "host/import/rgbd_import.h"
#include "lab/train/point_file.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

PointModel pointsOf(const char *recording) {
  RecordingOptions options;
  options.folder = recording;
  RgbdImportSummary summary;
  return importRgbd({{openRecording(options).get()}}, {}, {}, &summary);
}

void write(const PointModel &model, const std::string &path) {
  std::vector<Vector3> positions_m;
  std::vector<Descriptor> descriptors;
  for (const ModelPoint &point : model.points) {
    positions_m.push_back(point.position_m);
    descriptors.push_back(point.descriptor);
  }
  std::ofstream out(path, std::ios::binary);
  writePoints(positions_m, descriptors, &out);
  if (!out.flush()) throw std::runtime_error(path + " cannot be written; is the disk full?");
}

void run(char **arguments) { write(pointsOf(arguments[1]), arguments[2]); }

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("dump_points RECORDING OUT", argc == 3, [&] { sphc::host::run(argv); });
}
