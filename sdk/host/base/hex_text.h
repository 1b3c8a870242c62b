// Bytes as text.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace sphc::host {

// Two lower-case digits a byte, as map ids are written.
std::string hexText(const uint8_t *bytes, size_t count);

}  // namespace sphc::host
