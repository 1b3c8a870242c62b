// Small files, written whole or not at all.
#pragma once

#include <filesystem>

#include "host/recording/mcap/bytes.h"

namespace sphc::replay {

// Replaces one that is there.  Throws Failure.
void writeFile(const std::filesystem::path &path, ByteView bytes);
[[noreturn]] void failWrite(const std::filesystem::path &path);

}  // namespace sphc::replay
