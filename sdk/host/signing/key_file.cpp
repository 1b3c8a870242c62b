#include "host/signing/key_file.h"

#include <sodium.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "host/base/private_file.h"
#include "host/base/write_file.h"
#include "signature/statement.h"
#include "signature/strict_ed25519.h"

namespace sphc::host {
namespace {

constexpr char kSecretHead[] = "spherecloud secret signing key 1";
constexpr char kPublicHead[] = "spherecloud public signing key 1";

void startSodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot start: no source of randomness on this system");
}

// Text that held a secret leaves nothing in memory.
struct WipedText {
  std::string text;
  ~WipedText() { sodium_memzero(text.data(), text.size()); }
};

std::string hexOf(const uint8_t *bytes, size_t count) {
  std::string text(2 * count + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes, count);
  text.pop_back();
  return text;
}

// Reads the two lines of a key file; false when it holds anything else.
bool readKey(const std::string &path, const std::string &head, std::array<uint8_t, 32> *key) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("key file " + path + " cannot be read; spherecloud key makes one");
  WipedText read{std::string(head.size() + 1 + 2 * key->size() + 2, '\0')};
  in.read(read.text.data(), static_cast<std::streamsize>(read.text.size()));
  const size_t got = static_cast<size_t>(in.gcount());
  const size_t wanted = head.size() + 1 + 2 * key->size();
  if (got < wanted || got > wanted + 1 || (got == wanted + 1 && read.text[wanted] != '\n')) return false;
  if (read.text.compare(0, head.size() + 1, head + "\n") != 0) return false;
  size_t bytes = 0;
  return sodium_hex2bin(key->data(), key->size(), read.text.data() + head.size() + 1, 2 * key->size(), nullptr,
                        &bytes, nullptr) == 0 &&
         bytes == key->size();
}

}  // namespace

SigningKey::SigningKey(const Seed &seed) {
  startSodium();
  crypto_sign_seed_keypair(public_key_.bytes, secret_.data(), seed.data());
}

SigningKey::~SigningKey() { sodium_memzero(secret_.data(), secret_.size()); }

SigningKey::SigningKey(SigningKey &&other) noexcept : secret_(other.secret_), public_key_(other.public_key_) {
  sodium_memzero(other.secret_.data(), other.secret_.size());
}

SigningKey SigningKey::draw() {
  startSodium();
  Seed seed;
  randombytes_buf(seed.data(), seed.size());
  SigningKey key(seed);
  sodium_memzero(seed.data(), seed.size());
  return key;
}

SigningKey SigningKey::read(const std::string &path) {
  startSodium();
  checkPrivate(path, "whoever has it signs maps in your name");
  Seed seed;
  if (!readKey(path, kSecretHead, &seed))
    throw std::runtime_error("key file " + path +
                             " holds no secret key; give the file without .pub that spherecloud key wrote");
  SigningKey key(seed);
  sodium_memzero(seed.data(), seed.size());
  return key;
}

std::array<uint8_t, 64> SigningKey::sign(const uint8_t *bytes, size_t count) const {
  std::array<uint8_t, 64> signature;
  crypto_sign_detached(signature.data(), nullptr, bytes, count, secret_.data());
  return signature;
}

void SigningKey::write(const std::string &path, const std::string &public_path) const {
  const WipedText digits{hexOf(secret_.data(), 32)};
  const WipedText text{std::string(kSecretHead) + "\n" + digits.text + "\n"};
  writeFile(path, text.text, Readers::kOwner);
  writeFile(public_path,
            std::string(kPublicHead) + "\n" + hexOf(public_key_.bytes, sizeof public_key_.bytes) + "\n");
}

sphc_signature_key readPublicKey(const std::string &path) {
  std::array<uint8_t, 32> bytes;
  if (!readKey(path, kPublicHead, &bytes))
    throw std::runtime_error("key file " + path +
                             " holds no public key; give the file ending in .pub that spherecloud key wrote");
  if (!sphc_ed25519_is_good_key(bytes.data()))
    throw std::runtime_error("key file " + path +
                             " holds a number for which anybody can sign; get the public key anew from its owner");
  sphc_signature_key key;
  std::copy(bytes.begin(), bytes.end(), key.bytes);
  return key;
}

std::string keyIdText(const sphc_signature_key &key) {
  uint8_t id[SPHC_KEY_ID_BYTES];
  sphc_statement_key_id(key.bytes, id);
  return hexOf(id, sizeof id);
}

}  // namespace sphc::host
