// Files read whole, regular files alone: a FIFO or a device would wait for ever.
#pragma once

#include <filesystem>
#include <string>

#include "host/recording/failure.h"
#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// A descriptor of the regular file at `path`, to read; the caller closes it.  Throws Failure (DEVICE) without the
// name.
int openRegularFile(const std::filesystem::path &path);

// `content` becomes the file's.  Throws Failure without the name: DEVICE when it cannot be read or is no regular
// file, ARGUMENT when it is longer than `most_bytes`.
void readFile(const std::filesystem::path &path, size_t most_bytes, Bytes &content);
// Whether the file's first bytes are these.  Throws Failure with the name when it cannot be read.
bool beginsWith(const std::filesystem::path &path, std::string_view head);
// A list or another small text, without the byte-order mark before it.  Throws Failure with the name.
std::string readText(const std::filesystem::path &path);

// What `read` returns; a Failure of it gets the file's name in front.
template <typename Read>
auto inFile(const std::filesystem::path &file, Read &&read) {
  try {
    return read();
  } catch (const Failure &failure) {
    throw Failure(failure.status(), shortPath(file.string()) + ": " + failure.what());
  }
}

}  // namespace sphc::recording
