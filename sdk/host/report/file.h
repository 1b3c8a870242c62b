// Folders and small files; base/write_file.h writes them.  All throw std::runtime_error with cause and cure.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::host {

void makeFolder(const std::string &path);
// Nobody else may look into it, though it was there before.
void makePrivateFolder(const std::string &path);
std::vector<uint8_t> readBytes(const std::string &path);

}  // namespace sphc::host
