#include <algorithm>
#include <cstring>

#include "host/import/colmap_descriptors.h"
#include "host/import/colmap_model.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/refuse_or_do.h"
#include "tests/fuzz/targets.h"
#include "tests/unit/host/import/tiny_colmap.h"

namespace sphc::fuzz {
namespace {

using namespace sphc::host;

constexpr size_t kHeadBytes = 5;  // format, length of the cameras' and of the images' file

std::string takePart(const uint8_t **data, size_t *left, size_t wanted) {
  const size_t bytes = std::min(wanted, *left);
  const std::string part(*data, *data + bytes);
  *data += bytes;
  *left -= bytes;
  return part;
}

}  // namespace

std::vector<uint8_t> colmapSeed(const ColmapFiles &files) {
  const auto two = [](size_t n) { return std::string({static_cast<char>(n), static_cast<char>(n >> 8)}); };
  const std::string all = std::string(1, files.binary ? 0 : 1) + two(files.cameras.size()) +
                          two(files.images.size()) + files.cameras + files.images + files.points;
  return {all.begin(), all.end()};
}

void colmap(const uint8_t *data, size_t bytes) {
  if (bytes < kHeadBytes) return;
  const size_t cameras = data[1] + 256u * data[2], images = data[3] + 256u * data[4];
  ColmapFiles files;
  files.binary = data[0] % 2 == 0;
  data += kHeadBytes;
  bytes -= kHeadBytes;
  files.cameras = takePart(&data, &bytes, cameras);
  files.images = takePart(&data, &bytes, images);
  files.points = takePart(&data, &bytes, bytes);
  refuseOrDo([&files] {
    const ColmapModel model = parseColmapModel(files);
    for (const auto &[id, point] : model.points)
      for (const ColmapObservation &o : point.track) {
        const ColmapImage &image = model.images.at(o.image);
        if (!image.keypoints_px.at(o.keypoint).allFinite() || !model.cameras.count(image.camera))
          broken("links of a model that is read lead somewhere");
      }
    accept();
  });
}

void colmapDatabase(const uint8_t *data, size_t bytes) {
  const NamedFile file(data, bytes);
  refuseOrDo([&file] {
    describeFromDatabase(test::tinyColmapModel(1), file.path());
    accept();
  });
}

}  // namespace sphc::fuzz
