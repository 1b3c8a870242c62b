// cloud_stacks CLOUD OUT: the stacks of a cloud, and what tells their layers.  OUT, little-endian: uint32 points,
// uint32 features; of all points uint32 stack; float32 features.
#include <fstream>
#include <stdexcept>

#include "host/audit/attack/stack_features.h"
#include "host/audit/attack/stacks.h"
#include "lab/train/plain_values.h"
#include "lab/train/real_or_fake/cloud_file.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

void run(char **arguments) {
  const Published cloud = readCloud(arguments[1]).published;
  const std::vector<uint32_t> stacks = stacksOf(cloud.directions);
  const Eigen::MatrixXf values = stackFeatures(cloud.directions, neighboursIn(cloud), stacks);
  std::ofstream out(arguments[2], std::ios::binary);
  for (const Eigen::Index size : {values.rows(), values.cols()}) writePlain(static_cast<uint32_t>(size), &out);
  for (const uint32_t stack : stacks) writePlain(stack, &out);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index c = 0; c < values.cols(); ++c) writePlain(values(i, c), &out);
  if (!out.flush()) throw std::runtime_error(std::string(arguments[2]) + " cannot be written; is the disk full?");
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("cloud_stacks CLOUD OUT", argc == 3, [&] { sphc::host::run(argv); });
}
