// The files of a recording by their names: in a folder, or in a zip.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

class FileSet {
 public:
  virtual ~FileSet() = default;
  virtual bool has(const std::string &name) const = 0;
  // `content` becomes the file's.  Throws Failure without the name: DEVICE when it cannot be read, ARGUMENT when it
  // is over 256 MiB.
  virtual void read(const std::string &name, Bytes &content) = 0;
};

constexpr size_t kMostFileSetBytes = size_t{1} << 28;

std::unique_ptr<FileSet> filesOfFolder(const std::filesystem::path &folder);
// Throws Failure with the name: DEVICE when it is no zip, UNSUPPORTED in a build without libzip.
std::unique_ptr<FileSet> filesOfZip(const std::filesystem::path &file);
bool isZip(const std::filesystem::path &file);

}  // namespace sphc::recording
