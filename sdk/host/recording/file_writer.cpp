#include "file_writer.h"

#include <cstdio>
#include <system_error>

#include "failure.h"

namespace sphc::recording {

namespace fs = std::filesystem;

void failWrite(const fs::path &path) {
  throw Failure(SPHC_E_DEVICE, shortPath(path.string()) + ": cannot be written; is there room and permission?");
}

namespace {

bool putAll(const fs::path &path, ByteView bytes) {
  std::FILE *file = std::fopen(path.string().c_str(), "wb");
  if (!file) return false;
  const bool written = std::fwrite(bytes.data, 1, bytes.size, file) == bytes.size;
  return std::fclose(file) == 0 && written;
}

}  // namespace

void writeFile(const fs::path &path, ByteView bytes) {
  std::error_code error;
  const bool is_there = fs::exists(path, error);
  if (is_there && !fs::is_regular_file(path, error)) {  // a device or a pipe
    if (!putAll(path, bytes)) failWrite(path);
    return;
  }
  const fs::path target = is_there ? fs::canonical(path, error) : path;  // a link keeps pointing where it points
  const fs::path beside = target.string() + ".part";
  if (putAll(beside, bytes)) {
    fs::rename(beside, target, error);
    if (!error) return;
  }
  std::error_code ignored;
  fs::remove(beside, ignored);
  failWrite(path);
}

}  // namespace sphc::recording
