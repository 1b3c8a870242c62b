#include "mapped_buffer.h"

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace sphc::libcamera_plugin {

MappedBuffer::~MappedBuffer() {
  for (const Mapping &mapping : mappings_) munmap(mapping.data, mapping.bytes);
}

MappedBuffer::MappedBuffer(MappedBuffer &&other) noexcept
    : mappings_(std::exchange(other.mappings_, {})),
      planes_(std::exchange(other.planes_, {})),
      is_read_(std::exchange(other.is_read_, false)) {}

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

// A buffer of ordinary memory refuses, and has no cache of its own to care for.
void MappedBuffer::synchronize(uint64_t flags) const {
  for (const Mapping &mapping : mappings_) {
    dma_buf_sync sync = {flags | DMA_BUF_SYNC_READ};
    while (ioctl(mapping.file, DMA_BUF_IOCTL_SYNC, &sync) != 0 && (errno == EINTR || errno == EAGAIN)) {
    }
  }
}

void MappedBuffer::beginReading() {
  if (!is_read_) synchronize(DMA_BUF_SYNC_START);
  is_read_ = true;
}

void MappedBuffer::endReading() {
  if (is_read_) synchronize(DMA_BUF_SYNC_END);
  is_read_ = false;
}

}  // namespace sphc::libcamera_plugin
