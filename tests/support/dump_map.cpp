// Prints what the C++ reader makes of a map: for read_map_test.py, which compares.
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "runtime/map/crc32.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/features/extractor.h"

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  std::ifstream in(argv[1], std::ios::binary);
  const std::vector<char> file((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  sphc::MapView view;
  sphc_message message = {};
  const sphc_status status = sphc::MapView::open(file.data(), file.size(), sphc::kExtractorId, &view, &message);
  std::printf("status %s\n", sphc_status_name(status));
  if (status != SPHC_OK) return 0;
  std::printf("points %u\nband %d\n", view.pointCount(), static_cast<int>(view.band()));
  const sphc::Span<const sphc::Descriptor> descriptors = view.descriptors();
  std::printf("descriptor_crc %08" PRIx32 "\n",
              sphc::crc32(0, descriptors.data(), descriptors.size() * sphc::kDescriptorBytes));
  uint32_t crc = sphc::crc32(0, view.centroids().data(), view.centroids().size() * sphc::kDescriptorBytes);
  crc = sphc::crc32(crc, view.groupCentroids().data(), view.groupCentroids().size() * sphc::kDescriptorBytes);
  std::printf("centroid_crc %08" PRIx32 "\nsector_side %u\ncell_begins ", crc, view.sectorSide());
  for (uint32_t c = 0; c < view.cellCount(); ++c) std::printf(" %u", view.cell(c).begin);
  std::printf("\ngroup_begins ");
  for (uint32_t g = 0; g < view.groupCount(); ++g) std::printf(" %u", view.group(g).begin);
  std::printf("\n");
  for (uint32_t i = 0; i < view.pointCount(); ++i) {
    const sphc::Direction d = view.direction(i);
    std::printf("direction %.9g %.9g %.9g\n", static_cast<double>(d.x), static_cast<double>(d.y),
                static_cast<double>(d.z));
  }
  return 0;
}
