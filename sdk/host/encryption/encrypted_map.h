// Maps that lie encrypted on a device: encrypted by libsodium, decrypted as on a device.
#pragma once
#include <string>
#include <vector>

#include "host/keys/key_text.h"
#include "spherecloud/spherecloud_encryption.h"

namespace sphc::host {

// In what an encrypted map begins.
constexpr char kEncryptionHead[] = "SPHERECLOUD-ENC1";
// Where it stands, unless something else is said.
inline std::string encryptedPath(const std::string &map) { return map + ".enc"; }

// A secret key.  Wiped from memory at its end.
class EncryptionKey {
 public:
  static EncryptionKey draw() { return EncryptionKey(drawKey()); }
  // Throws std::runtime_error with cause and cure: not there, no such key, or readable by others.  What the file
  // holds is told nobody.
  static EncryptionKey read(const std::string &path);
  explicit EncryptionKey(KeyBytes bytes);
  ~EncryptionKey();
  EncryptionKey(EncryptionKey &&other) noexcept;
  EncryptionKey(const EncryptionKey &) = delete;
  EncryptionKey &operator=(const EncryptionKey &) = delete;

  const sphc_encryption_key &bytes() const { return key_; }
  // By this name a file says which key it is of; it tells nothing of the key.
  std::string idText() const;
  // The file with mode 0600.  Throws as writeNewFile does.
  void write(const std::string &path) const;

 private:
  sphc_encryption_key key_;
};

// Whatever the bytes are.  Each call gives another file, for its nonce is drawn.
std::vector<uint8_t> encryptMap(const void *map, size_t map_bytes, const EncryptionKey &key);

// Throws std::runtime_error with cause and cure; `path` is where the bytes were read.
std::vector<uint8_t> decryptMap(const std::string &path, const std::vector<uint8_t> &file,
                                const EncryptionKey &key);

}  // namespace sphc::host
