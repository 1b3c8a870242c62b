// The bytes of a sphere-cloud file; docs/map_format.md is the norm.  Little-endian.
#pragma once
#include <cstddef>
#include <cstdint>

namespace sphc {

constexpr uint8_t kMapMagic[8] = {0x89, 'S',  'P',  'H',
                                  'C',  '\r', '\n', 0x1A};  // as PNG: text modes break it visibly
constexpr uint32_t kMapVersion = 2;
constexpr uint32_t kMapMinPoints = 16, kMapMaxPoints = 1u << 24;
constexpr size_t kSectionAlignment = 64;
constexpr uint32_t kMapSections = 6;
// Of the index: cells of alike descriptors, groups of alike cells, and sectors of the sphere, side x side of them.
constexpr uint32_t kMapMaxCells = 4096, kMapMaxGroups = 256, kMapMaxSectorSide = 32;

struct MapHeader {
  uint8_t magic[8];
  uint16_t version;
  uint16_t band;  // sphc_band of the images; the upper half of the version, so that 0 is what was before it
  uint32_t extractor;
  uint64_t file_bytes;
  uint32_t point_count;
  uint32_t section_count;
  uint8_t map_id[16];
  uint32_t cell_count;
  uint32_t group_count;
  uint32_t sector_side;  // a power of two
  uint32_t crc32;        // of the header with this field zero, then of the section table
};
static_assert(sizeof(MapHeader) == 64 && offsetof(MapHeader, crc32) == 60);

enum SectionType : uint32_t {
  kSectionDirections = 1,
  kSectionDescriptors = 2,
  kSectionRuns = 3,       // where each sector of each cell begins
  kSectionCentroids = 4,  // of the cells
  kSectionGroups = 5,     // where each group of cells begins
  kSectionGroupCentroids = 6,
};

struct MapSection {
  uint32_t type;
  uint32_t element_bytes;
  uint64_t offset;
  uint64_t bytes;
  uint32_t crc32;
  uint32_t reserved;  // zero
};
static_assert(sizeof(MapSection) == 32);

// A unit direction as two 16-bit octahedral coordinates, 1 to 65535 for -1 to 1 (Cigolle et al. 2014, "A Survey of
// Efficient Representations for Independent Unit Vectors"); 0 is never written.  Largest error 0.07 mrad.
struct PackedDirection {
  uint16_t u, v;
};
static_assert(sizeof(PackedDirection) == 4);

}  // namespace sphc
