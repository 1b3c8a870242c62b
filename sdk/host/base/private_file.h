// Files that hold a secret.
#pragma once
#include <string>

namespace sphc::host {

// Throws std::runtime_error with cause and cure when `path` is a folder, or others than its owner may read it;
// `why` says what it would give away.  A file that is not there passes: reading it says so.
void checkPrivate(const std::string &path, const std::string &why);

}  // namespace sphc::host
