// Randomness that an attacker must not guess: which points are real hangs on it.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sphc::host {

using SecretKey = std::array<uint8_t, 32>;

// From the operating system.
SecretKey newSecretKey();
// 64 hexadecimal digits, from a file that holds nothing else; throws std::runtime_error with cause and cure.
SecretKey readSecretKey(const std::string &path);

// Bytes that say nothing without the key (BLAKE2b, 16 to 64 of them); another purpose gives others.
std::vector<uint8_t> keyedHash(const SecretKey &key, const std::string &purpose,
                               const std::vector<uint8_t> &content, size_t count);
// A key for one purpose.
SecretKey derivedKey(const SecretKey &key, const std::string &purpose);

// A stream of ChaCha20 (libsodium) under the key; the same key gives the same stream.
class SecretRandom {
 public:
  explicit SecretRandom(const SecretKey &key);

  uint64_t next();
  // Uniform in [0, bound), without bias.
  uint64_t below(uint64_t bound);
  double uniform();  // [0, 1)
  double normal();   // mean 0, variance 1

 private:
  void refill();

  SecretKey key_;
  uint64_t block_ = 0;
  std::array<uint64_t, 512> buffer_ = {};
  size_t used_ = 512;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

// Fisher and Yates.
template <typename T>
void shuffle(std::vector<T> *items, SecretRandom *random) {
  for (size_t i = items->size(); i > 1; --i) std::swap((*items)[i - 1], (*items)[random->below(i)]);
}

}  // namespace sphc::host
