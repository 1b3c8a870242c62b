#include "file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "host/recording/failure.h"
#include "host/recording/file_reader.h"

namespace sphc::recording {

namespace {

[[noreturn]] void fail(const std::string &name, const char *what, const char *cure) {
  const int error = errno;
  throw Failure(error == EEXIST ? SPHC_E_STATE : SPHC_E_DEVICE,
                name + ": " + what + ": " + std::generic_category().message(error) + "; " + cure);
}

}  // namespace

File::File(const std::filesystem::path &path) : descriptor_(-1), name_(shortPath(path.string())) {
  try {
    descriptor_ = openRegularFile(path);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), name_ + ": " + failure.what());
  }
}

File File::create(const std::filesystem::path &path) {
  File file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666), shortPath(path.string()));
  if (file.descriptor_ < 0)
    fail(file.name_, "cannot be made", "give the name of a new file in a folder that is there");
  return file;
}

File::~File() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

File::File(File &&other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), name_(std::move(other.name_)) {}

uint64_t File::size() const {
  struct stat status;
  if (::fstat(descriptor_, &status) != 0) fail(name_, "has no size", "give a file");
  return static_cast<uint64_t>(status.st_size);
}

void File::read(uint64_t offset, uint8_t *out, size_t size) const {
  while (size > 0) {
    const ssize_t got = ::pread(descriptor_, out, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(name_, "cannot be read", "check the disk");
    if (got == 0) throw Failure(SPHC_E_DEVICE, name_ + ": became shorter while it was read; copy it again");
    out += got;
    offset += static_cast<uint64_t>(got);
    size -= static_cast<size_t>(got);
  }
}

void File::write(ByteView part) {
  while (part.size > 0) {
    const ssize_t done = ::write(descriptor_, part.data, part.size);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail(name_, "cannot be written", "make room on the disk");
    part.data += done;
    part.size -= static_cast<size_t>(done);
  }
}

void File::writeAt(uint64_t offset, ByteView part) {
  while (part.size > 0) {
    const ssize_t done = ::pwrite(descriptor_, part.data, part.size, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail(name_, "cannot be written", "make room on the disk");
    part.data += done;
    part.size -= static_cast<size_t>(done);
    offset += static_cast<uint64_t>(done);
  }
}

void File::append(std::initializer_list<ByteView> parts) {
  const uint64_t before = size();
  try {
    for (const ByteView &part : parts) write(part);
  } catch (const Failure &) {
    truncate(before);
    throw;
  }
}

void File::sync() {
  if (::fdatasync(descriptor_) != 0) fail(name_, "cannot be brought to the disk", "check the disk");
}

void File::syncFolder(const std::filesystem::path &path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may be written but not read
  ::fsync(descriptor);         // some file systems know no such thing: the file's own sync has to do
  ::close(descriptor);
}

void File::truncate(uint64_t size) noexcept {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0)
    return;  // then its end is garbage, which readers bear
  ::lseek(descriptor_, 0, SEEK_END);
}

ByteView FileWindow::at(uint64_t offset, size_t size) {
  if (offset < start_ || offset + size > start_ + filled_) {
    filled_ = 0;
    const size_t bytes = static_cast<size_t>(std::min<uint64_t>(kMostBytes, size_ - offset));
    file_.read(offset, window_.data(), bytes);
    start_ = offset;
    filled_ = bytes;
  }
  return {window_.data() + (offset - start_), size};
}

}  // namespace sphc::recording
