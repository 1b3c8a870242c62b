// Text as a terminal shows it, in UTF-8.
#pragma once
#include <cstddef>
#include <string>

namespace sphc::host {

// Characters; each is taken for one column wide.
size_t columnsOf(const std::string &text);
// Its first characters, as many as fit; none is cut in two.
std::string fitting(const std::string &text, size_t columns);
// Of the terminal that is stderr, less the last one, after which some terminals wrap; 150 where there are more or
// it does not tell.
size_t shownColumns();

}  // namespace sphc::host
