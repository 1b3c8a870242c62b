// A frame buffer's planes, mapped for reading.
#pragma once

#include <libcamera/libcamera.h>

#include <vector>

#include "../plugin.h"

namespace sphc::libcamera_plugin {

class MappedBuffer {
 public:
  MappedBuffer() = default;
  ~MappedBuffer();
  MappedBuffer(MappedBuffer &&other) noexcept;
  MappedBuffer(const MappedBuffer &) = delete;
  MappedBuffer &operator=(const MappedBuffer &) = delete;

  // False, with errno, when the kernel refuses, or when the planes are more than two or reach out of their files.
  bool map(const libcamera::FrameBuffer &buffer);
  const sphc_libcamera_buffer &planes() const { return planes_; }
  // What the camera wrote is seen between these two: its writes go past a processor's cache (Linux, DMA-BUF).
  // Threads: one at a time.  Neither allocates.
  void beginReading();
  void endReading();

 private:
  struct Mapping {
    int file;
    void *data;
    size_t bytes;
  };
  const Mapping *mapping(int file);
  void synchronize(uint64_t flags) const;

  std::vector<Mapping> mappings_;
  sphc_libcamera_buffer planes_ = {};
  bool is_read_ = false;
};

}  // namespace sphc::libcamera_plugin
