// Keys that sign maps, and keys that are trusted to: Ed25519, in text files of two lines.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "host/keys/key_text.h"
#include "spherecloud/spherecloud_signature.h"

namespace sphc::host {

// A secret key with its public one.  Wiped from memory at its end.
class SigningKey {
 public:
  using Seed = KeyBytes;

  // From the operating system's randomness.
  static SigningKey draw();
  // Throws std::runtime_error with cause and cure: not there, no secret key, or readable by others.  What the file
  // holds is told nobody.
  static SigningKey read(const std::string &path);
  explicit SigningKey(const Seed &seed);
  ~SigningKey();
  SigningKey(SigningKey &&other) noexcept;
  SigningKey(const SigningKey &) = delete;
  SigningKey &operator=(const SigningKey &) = delete;

  const sphc_signature_key &publicKey() const { return public_key_; }
  // The Ed25519 signature of some bytes.
  std::array<uint8_t, 64> sign(const uint8_t *bytes, size_t count) const;
  // The file with mode 0600, and the public key's beside it: both or none.  Throws as writeNewFile does.
  void write(const std::string &path, const std::string &public_path) const;
  // The public key's file alone, as one that was lost.  Throws as writeNewFile does.
  void writePublic(const std::string &public_path) const;

 private:
  std::array<uint8_t, 64> secret_;  // as libsodium has it: the seed, then the public key
  sphc_signature_key public_key_;
};

// Throws std::runtime_error with cause and cure, where a secret key is given too.
sphc_signature_key readPublicKey(const std::string &path);

// 16 bytes in hexadecimal digits: by this name a signature says who made it.
std::string keyIdText(const sphc_signature_key &key);

}  // namespace sphc::host
