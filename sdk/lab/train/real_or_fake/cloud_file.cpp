#include "lab/train/real_or_fake/cloud_file.h"

#include <fstream>
#include <stdexcept>

#include "lab/train/point_file.h"

namespace sphc::host {

void writeCloud(const std::string &path, const KnownCloud &cloud) {
  std::ofstream out(path, std::ios::binary);
  writePoints(cloud.published.directions, cloud.published.descriptors, &out);
  for (const bool real : cloud.real) writePlain(static_cast<uint8_t>(real), &out);
  for (const uint32_t patch : cloud.patches) writePlain(patch, &out);
  if (!out.flush()) throw std::runtime_error(path + " cannot be written; is the disk full?");
}

KnownCloud readCloud(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  KnownCloud cloud;
  readPoints(&in, &cloud.published.directions, &cloud.published.descriptors);
  for (size_t i = 0; i < cloud.published.descriptors.size() && in; ++i)
    cloud.real.push_back(readPlain<uint8_t>(&in) != 0);
  for (size_t i = 0; i < cloud.real.size() && in; ++i) cloud.patches.push_back(readPlain<uint32_t>(&in));
  if (!in) throw std::runtime_error(path + " is missing or no cloud; publish_cloud makes them");
  return cloud;
}

}  // namespace sphc::host
