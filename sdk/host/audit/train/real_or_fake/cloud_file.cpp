#include "host/audit/train/real_or_fake/cloud_file.h"

#include <fstream>
#include <stdexcept>

#include "host/audit/train/real_or_fake/plain_values.h"

namespace sphc::host {

void writeCloud(const std::string &path, const KnownCloud &cloud) {
  std::ofstream out(path, std::ios::binary);
  writePlain(static_cast<uint32_t>(cloud.real.size()), &out);
  for (const Vector3 &direction : cloud.published.directions)
    for (int axis = 0; axis < 3; ++axis) writePlain(static_cast<float>(direction[axis]), &out);
  for (const Descriptor &descriptor : cloud.published.descriptors) writePlain(descriptor, &out);
  for (const bool real : cloud.real) writePlain(static_cast<uint8_t>(real), &out);
  if (!out.flush()) throw std::runtime_error(path + " cannot be written; is the disk full?");
}

KnownCloud readCloud(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  const auto count = readPlain<uint32_t>(&in);
  KnownCloud cloud;
  for (uint32_t i = 0; i < count && in; ++i) {
    const float x = readPlain<float>(&in), y = readPlain<float>(&in), z = readPlain<float>(&in);
    cloud.published.directions.emplace_back(x, y, z);
  }
  for (uint32_t i = 0; i < count && in; ++i) cloud.published.descriptors.push_back(readPlain<Descriptor>(&in));
  for (uint32_t i = 0; i < count && in; ++i) cloud.real.push_back(readPlain<uint8_t>(&in) != 0);
  if (!in) throw std::runtime_error(path + " is missing or no cloud; publish_cloud makes them");
  return cloud;
}

}  // namespace sphc::host
