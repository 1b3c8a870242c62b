// Text files of two lines: what a key is for, and its 32 bytes in hexadecimal digits.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "host/base/write_file.h"

namespace sphc::host {

// What stands in the first line.
constexpr char kSecretSigningHead[] = "spherecloud secret signing key 1";
constexpr char kPublicSigningHead[] = "spherecloud public signing key 1";
constexpr char kSecretEncryptionHead[] = "spherecloud secret encryption key 1";

using KeyBytes = std::array<uint8_t, 32>;

// Before any other call of libsodium.  Throws std::runtime_error where the system has no source of randomness.
void startSodium();

// Bytes that nobody can guess.
KeyBytes drawKey();
void wipe(KeyBytes *key);

// False when the file holds anything but `head` and a key.  Throws std::runtime_error when it cannot be read.  What
// it holds is told nobody and stays nowhere else in memory.
bool readKeyText(const std::string &path, const std::string &head, KeyBytes *key);
// For who was given another key than the one that is needed: "a public key"; "" where the file holds none of ours,
// and of a pipe, which gives its bytes only once.
std::string kindOfKey(const std::string &path);
// Throws as writeNewFile does: no key is ever replaced.
void writeKeyText(const std::string &path, const std::string &head, const uint8_t *key, Readers readers);

}  // namespace sphc::host
