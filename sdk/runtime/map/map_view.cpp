#include "runtime/map/map_view.h"

#include <cstring>

#include "runtime/base/message.h"
#include "runtime/map/crc32.h"

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
    if (status == SPHC_OK) status = checkExtractor(extractor);
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
  // Sections come in ascending order of type, so those every map has are the first ones.
  const void *directions() const { return file_ + section(0).offset; }
  const void *descriptors() const { return file_ + section(1).offset; }

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

  sphc_status checkHeader() const {
    if (bytes_ < sizeof(MapHeader))
      return fail(SPHC_E_MAP_FORMAT) << "map is " << bytes_ << " bytes, shorter than its header of "
                                     << sizeof(MapHeader) << kRebuild;
    if (std::memcmp(header().magic, kMapMagic, sizeof kMapMagic) != 0)
      return fail(SPHC_E_MAP_FORMAT) << "not a sphere-cloud file: it does not begin with the format's signature";
    if (header().version != kMapVersion)
      return fail(SPHC_E_MAP_VERSION) << "map has format version " << header().version << ", this library reads "
                                      << kMapVersion << "; update the library or rebuild the map";
    if (header().file_bytes != bytes_)
      return fail(SPHC_E_MAP_FORMAT) << "map says it has " << header().file_bytes << " bytes but "
                                     << static_cast<uint64_t>(bytes_) << " were given" << kRebuild;
    if (header().section_count < 2 || header().section_count > kMaxSections ||
        sizeof(MapHeader) + sizeof(MapSection) * header().section_count > bytes_)
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
    for (uint8_t byte : header().reserved)
      if (byte) return fail(SPHC_E_MAP_FORMAT) << "the map's reserved header bytes are not zero" << kRebuild;
    if (header().point_count < kMapMinPoints || header().point_count > kMapMaxPoints)
      return fail(SPHC_E_MAP_FORMAT) << "map has " << header().point_count << " points; allowed are "
                                     << kMapMinPoints << " to " << kMapMaxPoints;
    return SPHC_OK;
  }

  sphc_status checkExtractor(uint32_t extractor) const {
    if (header().extractor != extractor)
      return fail(SPHC_E_MAP_EXTRACTOR)
             << "map was described by extractor " << header().extractor << ", this library has " << extractor
             << "; rebuild the map with this version's builder";
    return SPHC_OK;
  }

  // Sections: known types in ascending order, aligned, gapless but for zero padding, of the right size, intact.
  sphc_status checkSection(uint32_t i, uint64_t *end) const {
    const MapSection &s = section(i);
    const uint32_t expected_type = i + 1;
    if (s.type != expected_type || i > 1)
      return fail(SPHC_E_MAP_FORMAT) << "map section " << i << " has the unknown type " << s.type << kRebuild;
    const uint32_t element = s.type == kSectionDirections ? sizeof(PackedDirection) : sizeof(Descriptor);
    const uint64_t offset = (*end + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
    if (s.element_bytes != element || s.bytes != uint64_t{element} * header().point_count || s.offset != offset ||
        s.reserved)
      return fail(SPHC_E_MAP_FORMAT) << "map section " << i << " does not fit " << header().point_count << " points"
                                     << kRebuild;
    if (s.offset > bytes_ || s.bytes > bytes_ - s.offset)
      return fail(SPHC_E_MAP_FORMAT) << "map section " << i << " reaches beyond the file's end" << kRebuild;
    for (uint64_t at = *end; at < offset; ++at)
      if (file_[at]) return fail(SPHC_E_MAP_FORMAT) << "the map's padding is not zero at byte " << at << kRebuild;
    if (crc32(0, file_ + s.offset, s.bytes) != s.crc32)
      return fail(SPHC_E_MAP_CHECKSUM) << "map section " << i << " was changed after writing" << kRebuild;
    *end = offset + s.bytes;
    return SPHC_OK;
  }

  sphc_status checkContents() const {
    const auto *packed = static_cast<const PackedDirection *>(directions());
    for (uint32_t i = 0; i < header().point_count; ++i)
      if (!packed[i].u || !packed[i].v)
        return fail(SPHC_E_MAP_FORMAT) << "direction " << i << " of the map is not a direction" << kRebuild;
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
  const uint32_t n = validator.header().point_count;
  view->header_ = &validator.header();
  view->directions_ = {static_cast<const PackedDirection *>(validator.directions()), n};
  view->descriptors_ = {static_cast<const Descriptor *>(validator.descriptors()), n};
  return SPHC_OK;
}

}  // namespace sphc
