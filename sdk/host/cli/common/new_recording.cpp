#include "host/cli/common/new_recording.h"

#include <filesystem>

#include "host/base/write_file.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

std::string withoutSlash(const std::string &path) {
  const fs::path normal = fs::path(path).lexically_normal();
  return normal.has_filename() ? normal.string() : normal.parent_path().string();
}

}  // namespace

std::string NewRecording::partOf(const std::string &path) { return withoutSlash(path) + ".part"; }

NewRecording::~NewRecording() {
  std::error_code ignored;
  if (!is_whole_ && if_cut_ == IfCut::kRemove) fs::remove_all(part_, ignored);
}

void NewRecording::finish() {
  std::error_code none;
  if (fs::is_directory(part_)) fs::remove(path_, none);  // a folder that is there is empty, or stays
  renameToNew(part_, withoutSlash(path_));
  is_whole_ = true;
}

}  // namespace sphc::host
