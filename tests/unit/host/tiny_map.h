// What tests of files need: a folder and a small map in it.
#pragma once
#include <cstdint>
#include <string>

namespace sphc::host {

// A folder of its own, removed at the end.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder &) = delete;
  TempFolder &operator=(const TempFolder &) = delete;
  std::string operator/(const std::string &name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

// A small valid map of made-up points.
void writeTinyMap(const std::string &path, uint32_t points);

}  // namespace sphc::host
