// Files that hold a secret.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>

namespace sphc::host {

// The first bytes of the file, at most `most`; none where it cannot be read.  Nothing else keeps them.  A pipe is
// read as far as somebody writes into it, so that a secret need not lie in a file.  Throws std::runtime_error with
// cause and cure where nobody does, and of a folder or a device.
std::optional<size_t> readPrivate(const std::string &path, char *out, size_t most);

// By the st_mode of a file: may others than its owner read, write or run it?
bool isForOthers(mode_t mode);

// Throws std::runtime_error with cause and cure when others than its owner may read the file; `why` says what it
// would give away.  A file that is not there passes: reading it says so.
void checkPrivate(const std::string &path, const std::string &why);

}  // namespace sphc::host
