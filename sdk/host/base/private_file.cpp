#include "host/base/private_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include "host/base/regular_file.h"
#include "host/base/shell_word.h"

namespace sphc::host {
namespace {

[[noreturn]] void refuse(const std::string &path, const std::string &what) {
  throw std::runtime_error("key file " + path + " is " + what + "; give the file itself");
}

// Closes itself.
struct Descriptor {
  explicit Descriptor(int of) : number(of) {}
  ~Descriptor() {
    if (number >= 0) close(number);  // else errno would no longer say why there is none
  }
  Descriptor(const Descriptor &) = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  int number;
};

// As read, but waits for a pipe that somebody has open to write; 0 where nobody has.
ssize_t readPart(int file, char *out, size_t most) {
  for (;;) {
    const ssize_t got = read(file, out, most);
    if (got >= 0 || (errno != EINTR && errno != EAGAIN)) return got;
    pollfd ready = {file, POLLIN, 0};
    poll(&ready, 1, -1);
  }
}

}  // namespace

std::optional<size_t> readPrivate(const std::string &path, char *out, size_t most) {
  checkMayRead(path);
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));  // a pipe opens at once
  struct stat facts = {};
  if (file.number < 0 || fstat(file.number, &facts) != 0) return {};
  if (!S_ISREG(facts.st_mode) && !S_ISFIFO(facts.st_mode))
    refuse(path, S_ISDIR(facts.st_mode) ? "a folder" : "a device");
  size_t filled = 0;
  for (ssize_t got = 1; got > 0 && filled < most; filled += static_cast<size_t>(got)) {
    got = readPart(file.number, out + filled, most - filled);
    if (got < 0) return {};
  }
  if (filled == 0 && S_ISFIFO(facts.st_mode)) refuse(path, "a pipe into which nobody writes");
  return filled;
}

bool isForOthers(mode_t mode) { return mode & (S_IRWXG | S_IRWXO); }

void checkPrivate(const std::string &path, const std::string &why) {
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0) return;
  if (isForOthers(facts.st_mode))
    throw std::runtime_error("key file " + path + ": others may read it, and " + why + "; run: chmod 600 " +
                             shellWord(path));
}

}  // namespace sphc::host
