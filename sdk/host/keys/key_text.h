// Text files of two lines: what a key is for, and its 32 bytes in hexadecimal digits.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "host/base/write_file.h"

namespace sphc::host {

using KeyBytes = std::array<uint8_t, 32>;

// Before any other call of libsodium.  Throws std::runtime_error where the system has no source of randomness.
void startSodium();

// Bytes that nobody can guess.
KeyBytes drawKey();
void wipe(KeyBytes *key);

// False when the file holds anything but `head` and a key.  Throws std::runtime_error when it cannot be read.  What
// it holds is told nobody and stays nowhere else in memory.
bool readKeyText(const std::string &path, const std::string &head, KeyBytes *key);
// Throws as writeNewFile does: no key is ever replaced.
void writeKeyText(const std::string &path, const std::string &head, const uint8_t *key, Readers readers);

}  // namespace sphc::host
