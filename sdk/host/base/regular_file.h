// Inputs that are files: of a pipe or a device the end may never come.
#pragma once
#include <string>

namespace sphc::host {

// Throws std::runtime_error with the cure where permissions keep this user from reading what is there.
void checkMayRead(const std::string &path);

// The same, and throws when something is there that is no file; `wanted` is what to give.  A path with nothing
// there passes: reading it says so.
void checkIsFile(const std::string &path, const std::string &wanted);

}  // namespace sphc::host
