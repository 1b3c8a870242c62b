#include "runtime/capi/growth.h"

#include <algorithm>
#include <cstring>

#include "runtime/base/message.h"

namespace sphc {
namespace {

constexpr size_t kMostBytes = 4096;  // no struct will ever have; beyond, the size is memory that nobody set
constexpr size_t kSizeBytes = sizeof(uint32_t);

uint32_t sizeOf(const void *growing) {
  uint32_t struct_size = 0;
  std::memcpy(&struct_size, growing, kSizeBytes);
  return struct_size;
}

bool isSize(const StructKind &kind, size_t struct_size) {
  return struct_size >= kind.first_bytes && struct_size <= kMostBytes && struct_size % kind.alignment == 0;
}

bool isZero(const unsigned char *bytes, size_t count) {
  return std::all_of(bytes, bytes + count, [](unsigned char byte) { return byte == 0; });
}

const unsigned char *bytesOf(const void *growing) { return static_cast<const unsigned char *>(growing); }
unsigned char *bytesOf(void *growing) { return static_cast<unsigned char *>(growing); }

}  // namespace

sphc_status readStructBytes(const StructKind &kind, const char *name, const void *from, void *known,
                            sphc_message *message) {
  uint32_t struct_size = 0;
  const sphc_status status = checkStructBytes(kind, name, from, message, &struct_size);
  if (status != SPHC_OK) return status;
  for (size_t i = kind.known_bytes; i < struct_size; ++i) {
    if (!bytesOf(from)[i]) continue;
    MessageWriter(message) << name << " is of a newer header than this library: byte " << static_cast<uint64_t>(i)
                           << " of it is set, and " << sphc_version_string() << " knows "
                           << static_cast<uint64_t>(kind.known_bytes)
                           << "; leave that field zero, or use a newer library";
    return SPHC_E_UNSUPPORTED;
  }
  std::memcpy(bytesOf(known) + kSizeBytes, bytesOf(from) + kSizeBytes,
              std::min<size_t>(struct_size, kind.known_bytes) - kSizeBytes);
  const auto own_size = static_cast<uint32_t>(kind.known_bytes);
  std::memcpy(known, &own_size, kSizeBytes);
  for (const FieldBytes &field : kind.reserved) {
    if (isZero(bytesOf(known) + field.offset, field.bytes)) continue;
    MessageWriter(message) << name << " has a reserved field that is not zero, at byte "
                           << static_cast<uint64_t>(field.offset)
                           << "; make the struct by its _init function, or of zeros";
    return SPHC_E_UNSUPPORTED;
  }
  return SPHC_OK;
}

sphc_status checkElementSize(const char *name, uint32_t index, const void *first, const void *element,
                             sphc_message *message) {
  if (!element || sizeOf(element) == sizeOf(first)) return SPHC_OK;
  MessageWriter(message) << name << "[" << index << "].struct_size is " << sizeOf(element) << ", and that of "
                         << name << "[0] is " << sizeOf(first)
                         << "; set it in all to what the elements of the array are apart";
  return SPHC_E_STRUCT_SIZE;
}

sphc_status checkStructBytes(const StructKind &kind, const char *name, const void *to, sphc_message *message,
                             uint32_t *struct_size) {
  if (!to) {
    MessageWriter(message) << name << " is null; give a " << kind.type;
    return SPHC_E_ARGUMENT;
  }
  *struct_size = sizeOf(to);
  if (isSize(kind, *struct_size)) return SPHC_OK;
  MessageWriter(message) << name << ".struct_size is " << *struct_size << "; set it to sizeof(" << kind.type
                         << "), here " << static_cast<uint64_t>(kind.known_bytes);
  return SPHC_E_STRUCT_SIZE;
}

void writeStructBytes(const StructKind &kind, const void *known, uint32_t struct_size, void *to) {
  const size_t shared = std::min<size_t>(struct_size, kind.known_bytes);
  std::memcpy(bytesOf(to) + kSizeBytes, bytesOf(known) + kSizeBytes, shared - kSizeBytes);
  std::memset(bytesOf(to) + shared, 0, struct_size - shared);
}

sphc_status initStructBytes(const StructKind &kind, const void *known, size_t struct_size, void *to) {
  if (!to) return SPHC_E_ARGUMENT;
  if (!isSize(kind, struct_size)) return SPHC_E_STRUCT_SIZE;
  const auto told = static_cast<uint32_t>(struct_size);
  std::memcpy(to, &told, kSizeBytes);
  writeStructBytes(kind, known, told, to);
  return SPHC_OK;
}

}  // namespace sphc
