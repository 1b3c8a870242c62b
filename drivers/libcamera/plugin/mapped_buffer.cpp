#include "mapped_buffer.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace sphc::libcamera_plugin {

MappedBuffer::~MappedBuffer() {
  for (const Mapping &mapping : mappings_) munmap(mapping.data, mapping.bytes);
}

MappedBuffer::MappedBuffer(MappedBuffer &&other) noexcept
    : mappings_(std::exchange(other.mappings_, {})), planes_(std::exchange(other.planes_, {})) {}

// Planes may share a file: each file is mapped once, as long as it is.
const MappedBuffer::Mapping *MappedBuffer::mapping(int file) {
  for (const Mapping &known : mappings_)
    if (known.file == file) return &known;
  const off_t bytes = lseek(file, 0, SEEK_END);
  if (bytes <= 0) return nullptr;
  mappings_.reserve(mappings_.size() + 1);  // may throw, and what is mapped then would stay so
  void *data = mmap(nullptr, static_cast<size_t>(bytes), PROT_READ, MAP_SHARED, file, 0);
  if (data == MAP_FAILED) return nullptr;
  mappings_.push_back({file, data, static_cast<size_t>(bytes)});
  return &mappings_.back();
}

bool MappedBuffer::map(const libcamera::FrameBuffer &buffer) {
  size_t count = 0;
  for (const libcamera::FrameBuffer::Plane &plane : buffer.planes()) {
    const Mapping *whole = mapping(plane.fd.get());
    if (!whole) return false;
    if (count == 2 || plane.offset > whole->bytes || plane.length > whole->bytes - plane.offset) {
      errno = ERANGE;
      return false;
    }
    planes_.data[count] = static_cast<const uint8_t *>(whole->data) + plane.offset;
    planes_.bytes[count] = plane.length;
    ++count;
  }
  return count > 0;
}

}  // namespace sphc::libcamera_plugin
