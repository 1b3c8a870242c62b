#include "host/report/file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "host/base/regular_file.h"

namespace sphc::host {

void makeFolder(const std::string &path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot make the folder " + path + ": " + error.message() +
                             "; choose another place or check permissions");
  }
}

void makePrivateFolder(const std::string &path) {
  makeFolder(path);
  std::error_code error;
  std::filesystem::permissions(path, std::filesystem::perms::owner_all, error);
  if (error)
    throw std::runtime_error("cannot make the folder " + path + " private: " + error.message() +
                             "; choose a place of your own");
}

std::vector<uint8_t> readBytes(const std::string &path) {
  checkIsFile(path, "the file itself");
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error("cannot read " + path + ": " + std::strerror(errno) +
                             "; check its name and permissions");
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace sphc::host
