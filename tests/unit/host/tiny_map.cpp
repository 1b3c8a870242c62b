#include "tests/unit/host/tiny_map.h"

#include <cmath>

#include "host/base/write_file.h"
#include "host/publish/map_writer.h"

namespace sphc::host {

void writeTinyMap(const std::string &path, uint32_t points) {
  SphereCloud cloud;
  for (uint32_t i = 0; i < points; ++i) {
    // A spiral from pole to pole: even, and without doubles.
    const double z = (2.0 * i + 1) / points - 1, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    SpherePoint point = {{r * std::cos(turn), r * std::sin(turn), z}, {}};
    for (size_t k = 0; k < kDescriptorBytes; ++k) {
      point.descriptor.bytes[k] = static_cast<uint8_t>(20 + (i * 7 + k * (i + 3)) % 50);
    }
    cloud.points.push_back(point);
  }
  writeFile(path, encodeMap(cloud, MapId{1, 2, 3}));
}

}  // namespace sphc::host
