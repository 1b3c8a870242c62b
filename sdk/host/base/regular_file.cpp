#include "host/base/regular_file.h"

#include <filesystem>
#include <stdexcept>

namespace sphc::host {

void checkIsFile(const std::string &path, const std::string &wanted) {
  std::error_code absent;
  const std::filesystem::file_status status = std::filesystem::status(path, absent);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) return;
  throw std::runtime_error(path +
                           (std::filesystem::is_directory(status) ? " is a folder" : " is a device or a pipe") +
                           "; give " + wanted);
}

}  // namespace sphc::host
