// Text files whose lines are fields with commas between them.
#pragma once

#include <string_view>
#include <vector>

namespace sphc::recording {

using Fields = std::vector<std::string_view>;

Fields fieldsOf(std::string_view line);
// Takes the first line off `text`, without the space around it.
std::string_view takeLine(std::string_view &text);

}  // namespace sphc::recording
