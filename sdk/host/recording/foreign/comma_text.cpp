#include "host/recording/foreign/comma_text.h"

#include "host/recording/text_field.h"

namespace sphc::recording {

Fields fieldsOf(std::string_view line) {
  Fields fields;
  for (size_t end = 0; end != std::string_view::npos;) {
    end = line.find(',');
    fields.push_back(trimmed(line.substr(0, end)));
    if (end != std::string_view::npos) line.remove_prefix(end + 1);
  }
  return fields;
}

std::string_view takeLine(std::string_view &text) {
  const size_t end = text.find('\n');
  const std::string_view line = trimmed(text.substr(0, end));
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace sphc::recording
