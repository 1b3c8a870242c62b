// cloud_features NETWORKS CLOUD OUT: what the classifier sees of a cloud.  OUT, little-endian: uint32 points,
// uint32 features, uint32 neighbours; of all points float32 features; int32 neighbours in direction; a byte, 1 for
// real.
#include <fstream>
#include <stdexcept>

#include "host/audit/attack/real_or_fake_features.h"
#include "lab/train/plain_values.h"
#include "lab/train/real_or_fake/cloud_file.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

void write(const Eigen::MatrixXf &values, const Eigen::ArrayXXi &beside, const std::vector<bool> &real,
           const std::string &path) {
  std::ofstream out(path, std::ios::binary);
  for (const Eigen::Index size : {values.rows(), values.cols(), beside.cols()})
    writePlain(static_cast<uint32_t>(size), &out);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index c = 0; c < values.cols(); ++c) writePlain(values(i, c), &out);
  for (Eigen::Index i = 0; i < beside.rows(); ++i)
    for (Eigen::Index k = 0; k < beside.cols(); ++k) writePlain(beside(i, k), &out);
  for (const bool one : real) writePlain(static_cast<uint8_t>(one), &out);
  if (!out.flush()) throw std::runtime_error(path + " cannot be written; is the disk full?");
}

void run(char **arguments) {
  const CoOccurrence co_occurrence(std::string(arguments[1]) + "/co_occurrence.json");
  const KnownCloud cloud = readCloud(arguments[2]);
  const MapNeighbours neighbours = neighboursIn(cloud.published);
  write(realOrFakeFeatures(cloud.published, neighbours, co_occurrence).values, neighbours.beside.indices,
        cloud.real, arguments[3]);
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("cloud_features NETWORKS CLOUD OUT", argc == 4, [&] { sphc::host::run(argv); });
}
