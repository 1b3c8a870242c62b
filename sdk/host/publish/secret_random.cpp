#include "host/publish/secret_random.h"

#include <sodium.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "host/base/private_file.h"

namespace sphc::host {
namespace {

constexpr size_t kMostKeyBytes = 256;  // the digits, and white space
constexpr char kWhiteSpace[] = " \t\n\v\f\r";

void startSodium() {
  if (sodium_init() < 0)
    throw std::runtime_error(
        "libsodium cannot start: no source of randomness on this system; give it /dev/urandom");
}

}  // namespace

SecretKey newSecretKey() {
  startSodium();
  SecretKey key;
  randombytes_buf(key.data(), key.size());
  return key;
}

SecretKey readSecretKey(const std::string &path) {
  startSodium();
  std::string text(kMostKeyBytes + 1, '\0');
  text.resize(readPrivate(path, text.data(), text.size()).value_or(0));
  const size_t begin = text.find_first_not_of(kWhiteSpace);
  if (begin == std::string::npos)
    throw std::runtime_error("key file " + path + " cannot be read; leave --key out, and the ledger draws one");
  SecretKey key;
  size_t bytes = 0;
  const size_t digits = text.find_last_not_of(kWhiteSpace) + 1 - begin;
  const bool parsed =
      sodium_hex2bin(key.data(), key.size(), text.data() + begin, digits, nullptr, &bytes, nullptr) == 0;
  const bool is_whole = text.size() <= kMostKeyBytes;  // nothing follows that was not looked at
  sodium_memzero(text.data(), text.size());
  if (!parsed || bytes != key.size() || digits != 2 * key.size() || !is_whole)
    throw std::runtime_error(
        "key file " + path +
        " does not hold exactly 64 hexadecimal digits; leave --key out, and the ledger draws one");
  if (sodium_is_zero(key.data(), key.size()))
    throw std::runtime_error(
        "key file " + path +
        " holds zeros alone, which anybody guesses; leave --key out, and the ledger draws one");
  checkPrivate(path, "it tells real points from fake ones");
  return key;
}

std::vector<uint8_t> keyedHash(const SecretKey &key, const std::string &purpose,
                               const std::vector<uint8_t> &content, size_t count) {
  startSodium();
  crypto_generichash_state state;
  std::vector<uint8_t> hash(count);
  if (crypto_generichash_init(&state, key.data(), key.size(), count) != 0)
    throw std::runtime_error("libsodium makes no hash of " + std::to_string(count) +
                             " bytes: a defect of this program; please report it");
  crypto_generichash_update(&state, reinterpret_cast<const uint8_t *>(purpose.c_str()), purpose.size() + 1);
  crypto_generichash_update(&state, content.data(), content.size());
  crypto_generichash_final(&state, hash.data(), count);
  return hash;
}

SecretKey derivedKey(const SecretKey &key, const std::string &purpose) {
  SecretKey derived;
  const std::vector<uint8_t> hash = keyedHash(key, purpose, {}, derived.size());
  std::copy(hash.begin(), hash.end(), derived.begin());
  return derived;
}

SecretRandom::SecretRandom(const SecretKey &key) : key_(key) { startSodium(); }

void SecretRandom::refill() {
  static_assert(crypto_stream_chacha20_KEYBYTES == 32 && crypto_stream_chacha20_NONCEBYTES == 8);
  uint8_t nonce[8];
  std::memcpy(nonce, &block_, sizeof nonce);
  ++block_;
  crypto_stream_chacha20(reinterpret_cast<uint8_t *>(buffer_.data()), sizeof buffer_, nonce, key_.data());
  used_ = 0;
}

uint64_t SecretRandom::next() {
  if (used_ == buffer_.size()) refill();
  return buffer_[used_++];
}

uint64_t SecretRandom::below(uint64_t bound) {
  const uint64_t unfair = (0 - bound) % bound;  // 2^64 mod bound: values below it would favour small results
  uint64_t value = next();
  while (value < unfair) value = next();
  return value % bound;
}

double SecretRandom::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

double SecretRandom::normal() {  // Box and Muller 1958
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2 * std::log(1 - uniform())), angle = 2 * M_PI * uniform();
  spare_normal_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

}  // namespace sphc::host
