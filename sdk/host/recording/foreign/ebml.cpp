#include "host/recording/foreign/ebml.h"

namespace sphc::recording {

namespace {

constexpr uint32_t kMostIdBytes = 4, kMostNumberBytes = 8;

uint64_t loadBig(ByteView bytes) {
  uint64_t value = 0;
  for (size_t i = 0; i < bytes.size; ++i) value = value << 8 | bytes.data[i];
  return value;
}

// The zero bits before the first one, and that one, say how many bytes there are; 0: none.
uint32_t lengthIn(uint8_t first) {
  for (uint32_t length = 1; length <= 8; ++length)
    if (first & (0x100u >> length)) return length;
  return 0;
}

}  // namespace

std::optional<ByteView> EbmlFile::bytesAt(uint64_t at, size_t bytes, uint64_t end) {
  if (at > end || end - at < bytes || bytes > FileWindow::kMostBytes) return {};
  return window_.at(at, bytes);
}

std::optional<uint64_t> EbmlFile::numberAt(uint64_t *at, uint64_t end) {
  const std::optional<ByteView> first = bytesAt(*at, 1, end);
  const uint32_t length = first ? lengthIn(first->data[0]) : 0;
  const std::optional<ByteView> bytes = length > 0 ? bytesAt(*at, length, end) : std::nullopt;
  if (!bytes) return {};
  *at += length;
  return loadBig(*bytes) & ((uint64_t{1} << (7 * length)) - 1);
}

std::optional<EbmlElement> EbmlFile::elementAt(uint64_t at, uint64_t end) {
  EbmlElement element;
  element.header = at;
  const std::optional<ByteView> first = bytesAt(at, 1, end);
  const uint32_t id_bytes = first ? lengthIn(first->data[0]) : 0;
  const std::optional<ByteView> id =
      id_bytes > 0 && id_bytes <= kMostIdBytes ? bytesAt(at, id_bytes, end) : std::nullopt;
  if (!id) return {};
  element.id = static_cast<uint32_t>(loadBig(*id));  // with its first bits, as the specification names it
  at += id_bytes;
  const uint64_t size_at = at;
  const std::optional<uint64_t> size = numberAt(&at, end);
  if (!size) return {};
  element.start = at;
  element.is_open = *size == (uint64_t{1} << (7 * (at - size_at))) - 1;
  element.is_cut = !element.is_open && *size > end - at;
  element.end = element.is_open || element.is_cut ? end : at + *size;
  return element;
}

uint64_t EbmlFile::unsignedOf(const EbmlElement &element) {
  const uint64_t bytes = element.end - element.start;
  return bytes > kMostNumberBytes ? 0 : loadBig(window_.at(element.start, static_cast<size_t>(bytes)));
}

std::string EbmlFile::textOf(const EbmlElement &element) {
  const std::optional<ByteView> bytes =
      bytesAt(element.start, static_cast<size_t>(element.end - element.start), element.end);
  if (!bytes) return {};
  const std::string text(recording::textOf(*bytes));
  return text.substr(0, text.find('\0'));  // the specification lets zeros follow
}

}  // namespace sphc::recording
