// What the plug-in of libcamera asks of the kernel before and after a buffer is read.  The program is linked with
// -Wl,--wrap=ioctl: no device here has memory that a cache hides.
#include <gtest/gtest.h>
#include <linux/dma-buf.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <utility>
#include <vector>

#include "drivers/libcamera/plugin/mapped_buffer.h"

namespace {

struct Kernel {
  std::vector<std::pair<int, uint64_t>> syncs;  // file and flags
  int interruptions = 0;
  bool is_ordinary_memory = false;
};
Kernel *kernel = nullptr;

}  // namespace

extern "C" int __wrap_ioctl(int file, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  const auto *sync = va_arg(arguments, const dma_buf_sync *);
  va_end(arguments);
  EXPECT_EQ(request, DMA_BUF_IOCTL_SYNC);
  errno = kernel->is_ordinary_memory ? ENOTTY : EINTR;
  if (kernel->is_ordinary_memory || kernel->interruptions-- > 0) return -1;
  kernel->syncs.emplace_back(file, sync->flags);
  return 0;
}

namespace sphc::libcamera_plugin {
namespace {

constexpr uint64_t kStart = DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ, kEnd = DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ;

libcamera::SharedFD memory(size_t bytes) {
  const int file = memfd_create("buffer", MFD_CLOEXEC);
  EXPECT_EQ(ftruncate(file, static_cast<off_t>(bytes)), 0);
  const libcamera::SharedFD shared(file);
  close(file);
  return shared;
}

class MappedBufferTest : public testing::Test {
 protected:
  MappedBufferTest() { kernel = &kernel_; }
  ~MappedBufferTest() override { kernel = nullptr; }

  using Planes = std::vector<libcamera::FrameBuffer::Plane>;
  const libcamera::SharedFD luma_ = memory(64), chroma_ = memory(32);
  Kernel kernel_;
};

TEST_F(MappedBufferTest, EachFileIsMadeReadableOnceAndGivenBackOnce) {
  MappedBuffer buffer;
  ASSERT_TRUE(buffer.map(libcamera::FrameBuffer(Planes{{luma_, 0, 64}, {chroma_, 0, 32}})));
  buffer.endReading();  // of a buffer that nobody reads
  EXPECT_TRUE(kernel_.syncs.empty());
  buffer.beginReading();
  buffer.beginReading();
  const std::vector<std::pair<int, uint64_t>> begun = {{luma_.get(), kStart}, {chroma_.get(), kStart}};
  EXPECT_EQ(kernel_.syncs, begun);
  kernel_.syncs.clear();
  buffer.endReading();
  buffer.endReading();
  const std::vector<std::pair<int, uint64_t>> ended = {{luma_.get(), kEnd}, {chroma_.get(), kEnd}};
  EXPECT_EQ(kernel_.syncs, ended);
}

TEST_F(MappedBufferTest, PlanesOfOneFileAreSynchronizedTogether) {
  MappedBuffer buffer;
  ASSERT_TRUE(buffer.map(libcamera::FrameBuffer(Planes{{luma_, 0, 32}, {luma_, 32, 32}})));
  buffer.beginReading();
  EXPECT_EQ(kernel_.syncs.size(), 1u);
}

TEST_F(MappedBufferTest, AnInterruptedCallIsMadeAgain) {
  MappedBuffer buffer;
  ASSERT_TRUE(buffer.map(libcamera::FrameBuffer(Planes{{luma_, 0, 64}})));
  kernel_.interruptions = 3;
  buffer.beginReading();
  EXPECT_EQ(kernel_.syncs.size(), 1u);
}

TEST_F(MappedBufferTest, OrdinaryMemoryIsReadAsItIs) {
  MappedBuffer buffer;
  ASSERT_TRUE(buffer.map(libcamera::FrameBuffer(Planes{{luma_, 0, 64}})));
  kernel_.is_ordinary_memory = true;
  buffer.beginReading();
  buffer.endReading();
  EXPECT_TRUE(kernel_.syncs.empty());
  EXPECT_EQ(buffer.planes().bytes[0], 64u);
}

}  // namespace
}  // namespace sphc::libcamera_plugin
