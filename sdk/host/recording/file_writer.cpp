#include "file_writer.h"

#include <cstdio>
#include <system_error>

#include "failure.h"

namespace sphc::recording {

namespace fs = std::filesystem;

void failWrite(const fs::path &path) {
  throw Failure(SPHC_E_DEVICE, shortPath(path.string()) + ": cannot be written; is there room and permission?");
}

void writeFile(const fs::path &path, ByteView bytes) {
  std::FILE *file = std::fopen(path.string().c_str(), "wb");
  if (!file) failWrite(path);
  const bool written = std::fwrite(bytes.data, 1, bytes.size, file) == bytes.size;
  if ((std::fclose(file) == 0) && written) return;
  std::error_code ignored;
  fs::remove(path, ignored);
  failWrite(path);
}

}  // namespace sphc::recording
