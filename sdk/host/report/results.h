// Files of results that are written in parts: each command owns the rows that begin with its key.
#pragma once
#include <string>
#include <vector>

namespace sphc::host {

// Puts `rows` (without line ends) where the file's rows that begin with `key` were, or at its end.  Makes the file,
// with `head` as its first line, when there is none.  Throws std::runtime_error, and leaves the file as it was,
// when it begins with something else.
void replaceRows(const std::string &path, const std::string &head, const std::string &key,
                 const std::vector<std::string> &rows);

}  // namespace sphc::host
