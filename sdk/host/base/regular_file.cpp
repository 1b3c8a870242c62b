#include "host/base/regular_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sphc::host {

void checkMayRead(const std::string &path) {
  if (access(path.c_str(), R_OK) != 0 && errno == EACCES)
    throw std::runtime_error(path + ": Permission denied; check its permissions and those of its folders");
}

void checkIsFile(const std::string &path, const std::string &wanted) {
  checkMayRead(path);
  std::error_code absent;
  const std::filesystem::file_status status = std::filesystem::status(path, absent);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) return;
  throw std::runtime_error(path +
                           (std::filesystem::is_directory(status) ? " is a folder" : " is a device or a pipe") +
                           "; give " + wanted);
}

}  // namespace sphc::host
