#include "host/signing/key_file.h"

#include <sodium.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "host/base/hex_text.h"
#include "host/base/private_file.h"
#include "host/keys/key_text.h"
#include "signature/statement.h"
#include "signature/strict_ed25519.h"

namespace sphc::host {
namespace {

[[noreturn]] void refuseKey(const std::string &path, const std::string &wanted, const std::string &cure) {
  const std::string kind = kindOfKey(path);
  throw std::runtime_error("key file " + path + " holds " + (kind.empty() ? "no " + wanted : kind) + cure);
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
  Seed seed = drawKey();
  SigningKey key(seed);
  wipe(&seed);
  return key;
}

SigningKey SigningKey::read(const std::string &path) {
  startSodium();
  Seed seed;
  if (!readKeyText(path, kSecretSigningHead, &seed))
    refuseKey(path, "secret key",
              ", and only a secret one of signatures signs; give the file without .pub that spherecloud key wrote");
  SigningKey key(seed);
  wipe(&seed);
  checkPrivate(path, "whoever has it signs maps in your name");
  return key;
}

std::array<uint8_t, 64> SigningKey::sign(const uint8_t *bytes, size_t count) const {
  std::array<uint8_t, 64> signature;
  crypto_sign_detached(signature.data(), nullptr, bytes, count, secret_.data());
  return signature;
}

void SigningKey::write(const std::string &path, const std::string &public_path) const {
  writeKeyText(path, kSecretSigningHead, secret_.data(), Readers::kOwner);
  try {
    writePublic(public_path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw;
  }
}

void SigningKey::writePublic(const std::string &public_path) const {
  writeKeyText(public_path, kPublicSigningHead, public_key_.bytes, Readers::kAll);
}

sphc_signature_key readPublicKey(const std::string &path) {
  KeyBytes bytes;
  if (!readKeyText(path, kPublicSigningHead, &bytes))
    refuseKey(path, "public key",
              ", and only a public one is trusted; give the file ending in .pub that spherecloud key wrote");
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
  return hexText(id, sizeof id);
}

}  // namespace sphc::host
