// Text as one word of a shell, for commands to copy.
#pragma once
#include <string>

namespace sphc::host {

// In quotes where it has more than letters, digits and what names of files often have.
std::string shellWord(const std::string &text);

}  // namespace sphc::host
