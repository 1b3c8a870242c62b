#include "file_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include "failure.h"
#include "host/base/text_encoding.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

namespace {

const char *kindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a FIFO";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

// Of a file that cannot be opened.
const char *cureOf(int error) {
  if (error == EACCES || error == EPERM) return "check its permissions and those of its folders";
  return error == EMFILE || error == ENFILE ? "close other files" : "is it there?";
}

// Closes itself.
struct Descriptor {
  ~Descriptor() { ::close(number); }
  int number;
};

}  // namespace

int openRegularFile(const std::filesystem::path &path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // a FIFO opens at once
  // A socket cannot be opened at all.
  if (descriptor < 0 && errno == ENXIO)
    throw Failure(SPHC_E_DEVICE, "is a socket or a device; give a regular file");
  if (descriptor < 0)
    throw Failure(SPHC_E_DEVICE,
                  "cannot be read: " + std::generic_category().message(errno) + "; " + cureOf(errno));
  struct stat status = {};
  const bool is_known = ::fstat(descriptor, &status) == 0;
  if (is_known && S_ISREG(status.st_mode)) return descriptor;
  const int error = errno;
  ::close(descriptor);
  if (!is_known)
    throw Failure(SPHC_E_DEVICE, "cannot be read: " + std::generic_category().message(error) + "; check the disk");
  throw Failure(SPHC_E_DEVICE, std::string("is ") + kindOf(status.st_mode) + "; give a regular file");
}

void readFile(const std::filesystem::path &path, size_t most_bytes, Bytes &content) {
  constexpr size_t kPieceBytes = 1 << 16;
  const Descriptor file{openRegularFile(path)};
  struct stat status = {};
  ::fstat(file.number, &status);
  size_t filled = 0;
  // One byte more than it says, to see that it ends there.
  content.resize(std::min(static_cast<size_t>(status.st_size), most_bytes) + 1);
  for (;;) {
    const ssize_t got = ::read(file.number, content.data() + filled, content.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw Failure(SPHC_E_DEVICE,
                    "cannot be read: " + std::generic_category().message(errno) + "; check the disk");
    if (got == 0) break;
    filled += static_cast<size_t>(got);
    if (filled > most_bytes)
      throw Failure(SPHC_E_ARGUMENT, "is over " + std::to_string(most_bytes >> 20) + " MiB; is it the right file?");
    if (filled == content.size()) content.resize(filled + kPieceBytes);  // it grows while it is read
  }
  content.resize(filled);
}

bool beginsWith(const std::filesystem::path &path, std::string_view head) {
  const File file(path);
  if (file.size() < head.size()) return false;
  Bytes begin(head.size());
  file.read(0, begin.data(), begin.size());
  return textOf(viewOf(begin)) == head;
}

std::string readText(const std::filesystem::path &path) {
  constexpr size_t kMostBytes = size_t{1} << 28;  // a list of a day at 30 Hz has 1e8 bytes
  Bytes content;
  try {
    readFile(path, kMostBytes, content);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath(path.string()) + ": " + failure.what());
  }
  const std::string_view text = textOf(viewOf(content));
  if (host::isUtf16(text))
    throw Failure(SPHC_E_ARGUMENT, shortPath(path.string()) + ": is in UTF-16; save it as UTF-8");
  return std::string(host::withoutByteOrderMark(text));
}

}  // namespace sphc::recording
