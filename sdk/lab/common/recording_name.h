// What a recording is called in tables.
#pragma once
#include <filesystem>
#include <string>

namespace sphc::host {

// The last part of its path: "kitchen" of "data/kitchen/".
inline std::filesystem::path recordingName(const std::string &path) {
  const std::filesystem::path plain = std::filesystem::path(path).lexically_normal();
  return plain.has_filename() ? plain.filename() : plain.parent_path().filename();
}

}  // namespace sphc::host
