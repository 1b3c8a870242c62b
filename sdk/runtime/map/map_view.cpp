#include "runtime/map/map_view.h"

#include <cstring>

#include "runtime/base/message.h"
#include "runtime/map/crc32.h"
#include "runtime/map/sector.h"

namespace sphc {
namespace {

// The whole check, field by field; the first fault found is explained.
class Validator {
 public:
  Validator(const void *file, size_t bytes, sphc_message *message)
      : file_(static_cast<const uint8_t *>(file)), bytes_(bytes), message_(message) {}

  sphc_status check(uint32_t extractor) {
    sphc_status status = checkHeader();
    if (status == SPHC_OK) status = checkTable();
    if (status == SPHC_OK) status = checkMaker(extractor);
    if (status != SPHC_OK) return status;  // the header is not to be read any further
    uint64_t end = sizeof(MapHeader) + sizeof(MapSection) * header().section_count;
    for (uint32_t i = 0; status == SPHC_OK && i < header().section_count; ++i) status = checkSection(i, &end);
    if (status == SPHC_OK && end != bytes_)
      return fail(SPHC_E_MAP_FORMAT) << "map has " << bytes_ - end << " bytes after its last section" << kRebuild;
    if (status == SPHC_OK) status = checkContents();
    return status;
  }

  const MapHeader &header() const { return *reinterpret_cast<const MapHeader *>(file_); }
  const MapSection &section(uint32_t i) const {
    return reinterpret_cast<const MapSection *>(file_ + sizeof(MapHeader))[i];
  }
  // The elements of a section that has passed its check.
  template <typename T>
  Span<const T> elements(SectionType type) const {
    const MapSection &s = section(type - 1);  // they come in ascending order of type
    return {reinterpret_cast<const T *>(file_ + s.offset), static_cast<size_t>(s.bytes) / sizeof(T)};
  }

 private:
  static constexpr const char *kRebuild = "; copy the file again or rebuild the map";

  // Lets a message be written and a status returned in one statement.
  struct Failure {
    MessageWriter writer;
    sphc_status status;
    template <typename T>
    Failure &operator<<(const T &part) {
      writer << part;
      return *this;
    }
    operator sphc_status() const { return status; }
  };
  Failure fail(sphc_status status) const { return {MessageWriter(message_), status}; }

  // Byte by byte: firmware need not have memcmp.
  bool hasMagic() const {
    for (size_t i = 0; i < sizeof kMapMagic; ++i)
      if (header().magic[i] != kMapMagic[i]) return false;
    return true;
  }

  sphc_status checkHeader() const {
    if (bytes_ < sizeof(MapHeader))
      return fail(SPHC_E_MAP_FORMAT) << "map is " << bytes_ << " bytes, shorter than its header of "
                                     << sizeof(MapHeader) << kRebuild;
    if (!hasMagic())
      return fail(SPHC_E_MAP_FORMAT) << "not a sphere-cloud file: it does not begin with the format's signature; "
                                        "give the file that the builder wrote";
    if (header().version != kMapVersion)
      return fail(SPHC_E_MAP_VERSION) << "map has format version " << uint32_t{header().version}
                                      << ", this library reads " << kMapVersion
                                      << "; update the library or rebuild the map";
    if (header().file_bytes != bytes_)
      return fail(SPHC_E_MAP_FORMAT) << "map says it has " << header().file_bytes << " bytes but "
                                     << static_cast<uint64_t>(bytes_) << " were given" << kRebuild;
    if (header().section_count != kMapSections || sizeof(MapHeader) + sizeof(MapSection) * kMapSections > bytes_)
      return fail(SPHC_E_MAP_FORMAT) << "map has an impossible section count " << header().section_count
                                     << kRebuild;
    return SPHC_OK;
  }

  sphc_status checkTable() const {
    MapHeader copy = header();
    copy.crc32 = 0;
    uint32_t crc = crc32(0, &copy, sizeof copy);
    crc = crc32(crc, file_ + sizeof copy, sizeof(MapSection) * header().section_count);
    if (crc != header().crc32)
      return fail(SPHC_E_MAP_CHECKSUM) << "the map's header or section table was changed after writing" << kRebuild;
    if (header().point_count < kMapMinPoints || header().point_count > kMapMaxPoints)
      return fail(SPHC_E_MAP_FORMAT) << "map has " << header().point_count << " points; allowed are "
                                     << kMapMinPoints << " to " << kMapMaxPoints << kRebuild;
    const uint32_t cells = header().cell_count, groups = header().group_count, side = header().sector_side;
    if (cells > kMapMaxCells || groups == 0 || groups > kMapMaxGroups || groups > cells)
      return fail(SPHC_E_MAP_FORMAT) << "map has an impossible index of " << cells << " cells in " << groups
                                     << " groups" << kRebuild;
    if (side == 0 || side > kMapMaxSectorSide || (side & (side - 1)))
      return fail(SPHC_E_MAP_FORMAT) << "map has an impossible sector grid of side " << side << kRebuild;
    return SPHC_OK;
  }

  sphc_status checkMaker(uint32_t extractor) const {
    if (header().band > SPHC_BAND_INFRARED)
      return fail(SPHC_E_MAP_VERSION) << "map is of band " << uint32_t{header().band}
                                      << ", which this library does not know; update the library";
    if (header().extractor != extractor)
      return fail(SPHC_E_MAP_EXTRACTOR)
             << "map was described by extractor " << header().extractor << ", this library has " << extractor
             << "; rebuild the map with this version's builder";
    return SPHC_OK;
  }

  struct SectionShape {
    uint32_t element_bytes;
    uint64_t count;
  };
  SectionShape shapeOf(uint32_t type) const {
    const uint64_t side = header().sector_side;
    switch (type) {
      case kSectionDirections:
        return {sizeof(PackedDirection), header().point_count};
      case kSectionDescriptors:
        return {sizeof(Descriptor), header().point_count};
      case kSectionRuns:
        return {sizeof(uint32_t), header().cell_count * side * side + 1};
      case kSectionCentroids:
        return {sizeof(Descriptor), header().cell_count};
      case kSectionGroups:
        return {sizeof(uint32_t), uint64_t{header().group_count} + 1};
      default:
        return {sizeof(Descriptor), header().group_count};
    }
  }

  // Sections: known types in ascending order, aligned, gapless but for zero padding, of the right size, intact.
  sphc_status checkSection(uint32_t i, uint64_t *end) const {
    const MapSection &s = section(i);
    if (s.type != i + 1)
      return fail(SPHC_E_MAP_FORMAT) << "map section " << i << " has the unexpected type " << s.type << kRebuild;
    const SectionShape shape = shapeOf(s.type);
    const uint64_t offset = (*end + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
    if (s.element_bytes != shape.element_bytes || s.bytes != shape.element_bytes * shape.count ||
        s.offset != offset || s.reserved)
      return fail(SPHC_E_MAP_FORMAT) << "map section " << i << " does not fit " << header().point_count << " points"
                                     << kRebuild;
    if (s.offset > bytes_ || s.bytes > bytes_ - s.offset)
      return fail(SPHC_E_MAP_FORMAT) << "map section " << i << " reaches beyond the file's end" << kRebuild;
    for (uint64_t at = *end; at < offset; ++at)
      if (file_[at]) return fail(SPHC_E_MAP_FORMAT) << "the map's padding is not zero at byte " << at << kRebuild;
    if (crc32(0, file_ + s.offset, static_cast<size_t>(s.bytes)) != s.crc32)
      return fail(SPHC_E_MAP_CHECKSUM) << "map section " << i << " was changed after writing" << kRebuild;
    *end = offset + s.bytes;
    return SPHC_OK;
  }

  sphc_status checkContents() const {
    const auto packed = elements<PackedDirection>(kSectionDirections);
    for (uint32_t i = 0; i < header().point_count; ++i)
      if (!packed[i].u || !packed[i].v)
        return fail(SPHC_E_MAP_FORMAT) << "direction " << i << " of the map is not a direction" << kRebuild;
    sphc_status status = checkOffsets(kSectionGroups, "group", header().cell_count);
    if (status == SPHC_OK) status = checkOffsets(kSectionRuns, "run", header().point_count);
    return status == SPHC_OK ? checkSectors() : status;
  }

  // Offsets begin with 0, never fall, and end with `total`.
  sphc_status checkOffsets(SectionType type, const char *name, uint32_t total) const {
    const auto offsets = elements<uint32_t>(type);
    uint32_t last = 0;
    for (size_t i = 0; i < offsets.size(); ++i) {
      const bool right = i == 0 ? offsets[i] == 0 : offsets[i] >= last && offsets[i] <= total;
      if (!right || (i + 1 == offsets.size() && offsets[i] != total))
        return fail(SPHC_E_MAP_FORMAT) << name << " " << static_cast<uint64_t>(i)
                                       << " of the map's index begins at an impossible place" << kRebuild;
      last = offsets[i];
    }
    return SPHC_OK;
  }

  // Every point lies in the sector under which the index lists it.
  sphc_status checkSectors() const {
    const auto runs = elements<uint32_t>(kSectionRuns);
    const auto packed = elements<PackedDirection>(kSectionDirections);
    const uint32_t side = header().sector_side;
    for (size_t run = 0; run + 1 < runs.size(); ++run)
      for (uint32_t i = runs[run]; i < runs[run + 1]; ++i)
        if (sectorOf(packed[i], side) != run % (side * side))
          return fail(SPHC_E_MAP_FORMAT)
                 << "point " << i << " of the map is not in the sector that lists it" << kRebuild;
    return SPHC_OK;
  }

  const uint8_t *file_;
  size_t bytes_;
  sphc_message *message_;
};

}  // namespace

sphc_status MapView::open(const void *file, size_t file_bytes, uint32_t extractor, MapView *view,
                          sphc_message *message) {
  Validator validator(file, file_bytes, message);
  const sphc_status status = validator.check(extractor);
  if (status != SPHC_OK) return status;
  view->header_ = &validator.header();
  view->directions_ = validator.elements<PackedDirection>(kSectionDirections);
  view->descriptors_ = validator.elements<Descriptor>(kSectionDescriptors);
  view->runs_ = validator.elements<uint32_t>(kSectionRuns);
  view->centroids_ = validator.elements<Descriptor>(kSectionCentroids);
  view->groups_ = validator.elements<uint32_t>(kSectionGroups);
  view->group_centroids_ = validator.elements<Descriptor>(kSectionGroupCentroids);
  return SPHC_OK;
}

}  // namespace sphc
