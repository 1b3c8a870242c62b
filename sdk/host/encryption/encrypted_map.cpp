#include "host/encryption/encrypted_map.h"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>

#include "encryption/file_header.h"
#include "host/base/hex_text.h"
#include "host/base/private_file.h"

namespace sphc::host {
namespace {

[[noreturn]] void refuseEncryptionKey(const std::string &path) {
  const std::string kind = kindOfKey(path);
  throw std::runtime_error("key file " + path + " holds " +
                           (kind.empty() ? "no key of encrypted maps" : kind + ", and none of encrypted maps") +
                           "; give the file that spherecloud key --for encryption wrote");
}

}  // namespace

EncryptionKey::EncryptionKey(KeyBytes bytes) {
  std::copy(bytes.begin(), bytes.end(), key_.bytes);
  wipe(&bytes);
}

EncryptionKey::~EncryptionKey() { sodium_memzero(key_.bytes, sizeof key_.bytes); }

EncryptionKey::EncryptionKey(EncryptionKey &&other) noexcept : key_(other.key_) {
  sodium_memzero(other.key_.bytes, sizeof other.key_.bytes);
}

EncryptionKey EncryptionKey::read(const std::string &path) {
  startSodium();
  KeyBytes bytes;
  if (!readKeyText(path, kSecretEncryptionHead, &bytes)) refuseEncryptionKey(path);
  EncryptionKey key(bytes);
  wipe(&bytes);
  checkPrivate(path, "whoever has it decrypts your maps");
  return key;
}

std::string EncryptionKey::idText() const {
  uint8_t id[SPHC_ENCRYPTION_KEY_ID_BYTES];
  sphc_encryption_key_id(&key_, id);
  return hexText(id, sizeof id);
}

void EncryptionKey::write(const std::string &path) const {
  writeKeyText(path, kSecretEncryptionHead, key_.bytes, Readers::kOwner);
}

std::vector<uint8_t> encryptMap(const void *map, size_t map_bytes, const EncryptionKey &key) {
  startSodium();
  std::vector<uint8_t> file(map_bytes + SPHC_ENCRYPTION_ADDED_BYTES);
  sphc_encryption_header header;
  header.map_bytes = map_bytes;
  sphc_encryption_key_id(&key.bytes(), header.key_id);
  randombytes_buf(header.nonce, sizeof header.nonce);
  sphc_encryption_header_write(&header, file.data());
  crypto_aead_xchacha20poly1305_ietf_encrypt(
      file.data() + SPHC_ENCRYPTION_HEADER_BYTES, nullptr, static_cast<const uint8_t *>(map), map_bytes,
      file.data(), SPHC_ENCRYPTION_HEADER_BYTES, nullptr, header.nonce, key.bytes().bytes);
  return file;
}

std::vector<uint8_t> decryptMap(const std::string &path, const std::vector<uint8_t> &file,
                                const EncryptionKey &key) {
  std::vector<uint8_t> map(std::max<size_t>(file.size(), SPHC_ENCRYPTION_ADDED_BYTES) -
                           SPHC_ENCRYPTION_ADDED_BYTES);
  uint8_t nothing;  // data() of no bytes may be null
  sphc_message message = {};
  const sphc_status status =
      sphc_encryption_decrypt(&key.bytes(), file.empty() ? &nothing : file.data(), file.size(),
                              map.empty() ? &nothing : map.data(), map.size(), &message);
  if (status == SPHC_OK) return map;
  throw std::runtime_error("cannot decrypt " + path + ": " + message.text + " [" +
                           sphc_encryption_status_name(status) + "]");
}

}  // namespace sphc::host
