#include "file_writer.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "failure.h"
#include "host/base/part_name.h"

namespace sphc::recording {

namespace fs = std::filesystem;

void failWrite(const fs::path &path) {
  const std::string why = std::strerror(errno);
  throw Failure(SPHC_E_DEVICE,
                shortPath(path.string()) + ": cannot be written: " + why + "; is there room and permission?");
}

namespace {

bool putAll(const fs::path &path, const char *mode, ByteView bytes) {
  std::FILE *file = std::fopen(path.string().c_str(), mode);
  if (!file) return false;
  const bool written = std::fwrite(bytes.data, 1, bytes.size, file) == bytes.size;
  return std::fclose(file) == 0 && written;
}

}  // namespace

void writeFile(const fs::path &path, ByteView bytes) {
  std::error_code error;
  const bool is_there = fs::exists(path, error);
  if (is_there && !fs::is_regular_file(path, error)) {  // a device or a pipe
    if (!putAll(path, "wb", bytes)) failWrite(path);
    return;
  }
  const fs::path target = is_there ? fs::canonical(path) : path;  // a link keeps pointing where it points
  const fs::path beside = host::partName(target.string());
  if (putAll(beside, "wbx", bytes) && std::rename(beside.c_str(), target.c_str()) == 0) return;
  const int why = errno;
  std::remove(beside.c_str());
  errno = why;
  failWrite(path);
}

}  // namespace sphc::recording
