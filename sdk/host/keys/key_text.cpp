#include "host/keys/key_text.h"

#include <sodium.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "host/base/private_file.h"

namespace sphc::host {
namespace {

// Text that held a secret leaves nothing in memory.
struct WipedText {
  std::string text;
  ~WipedText() { sodium_memzero(text.data(), text.size()); }
};

std::string secretDigits(const uint8_t *bytes, size_t count) {
  std::string text(2 * count + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes, count);
  text.pop_back();
  return text;
}

}  // namespace

void startSodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot start: no source of randomness on this system");
}

KeyBytes drawKey() {
  startSodium();
  KeyBytes key;
  randombytes_buf(key.data(), key.size());
  return key;
}

void wipe(KeyBytes *key) { sodium_memzero(key->data(), key->size()); }

bool readKeyText(const std::string &path, const std::string &head, KeyBytes *key) {
  WipedText read{std::string(head.size() + 1 + 2 * key->size() + 2, '\0')};
  const std::optional<size_t> got = readPrivate(path, read.text.data(), read.text.size());
  if (!got)
    throw std::runtime_error("key file " + path + " cannot be read: " + std::strerror(errno) +
                             "; give the file that spherecloud key wrote");
  const size_t wanted = head.size() + 1 + 2 * key->size();
  if (*got < wanted || *got > wanted + 1 || (*got == wanted + 1 && read.text[wanted] != '\n')) return false;
  if (read.text.compare(0, head.size() + 1, head + "\n") != 0) return false;
  size_t bytes = 0;
  const bool is_read = sodium_hex2bin(key->data(), key->size(), read.text.data() + head.size() + 1, 2 * key->size(),
                                      nullptr, &bytes, nullptr) == 0 &&
                       bytes == key->size();
  if (!is_read) wipe(key);
  return is_read;
}

std::string kindOfKey(const std::string &path) {
  struct Kind {
    const char *head, *words;
  };
  constexpr Kind kKinds[] = {{kSecretSigningHead, "a secret key that signs maps"},
                             {kPublicSigningHead, "a public key"},
                             {kSecretEncryptionHead, "a key of encrypted maps"}};
  if (!std::filesystem::is_regular_file(path)) return "";
  for (const Kind &kind : kKinds) {
    KeyBytes bytes;
    if (!readKeyText(path, kind.head, &bytes)) continue;
    wipe(&bytes);
    return kind.words;
  }
  return "";
}

void writeKeyText(const std::string &path, const std::string &head, const uint8_t *key, Readers readers) {
  const WipedText digits{secretDigits(key, KeyBytes().size())};
  WipedText text;
  text.text.reserve(head.size() + digits.text.size() + 2);  // a text that grows leaves its bytes where it was
  text.text.append(head).append("\n").append(digits.text).append("\n");
  writeNewFile(path, text.text, readers);
}

}  // namespace sphc::host
