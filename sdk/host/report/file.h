// Small files, whole.  All throw std::runtime_error with cause and cure.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::host {

void makeFolder(const std::string &path);
void writeText(const std::string &path, const std::string &text);
std::vector<uint8_t> readBytes(const std::string &path);

}  // namespace sphc::host
