// Small files, written whole or not at all: what fails or is killed leaves the old one, and at most NAME.part.
// host/base/write_file.h also brings them to the disk.  It is not installed, but this library is, for programs that
// link the drivers alone.
#pragma once

#include <filesystem>

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// Replaces one that is there.  Throws Failure.
void writeFile(const std::filesystem::path &path, ByteView bytes);
// With the cause that errno tells.
[[noreturn]] void failWrite(const std::filesystem::path &path);

}  // namespace sphc::recording
