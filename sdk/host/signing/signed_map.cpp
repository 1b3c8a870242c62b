#include "host/signing/signed_map.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/base/regular_file.h"
#include "host/base/usage_error.h"
#include "signature/statement.h"

namespace sphc::host {
namespace {

// One byte more than a signature has, where it is there: that is enough to refuse it.
std::vector<uint8_t> readSignature(const std::string &path) {
  std::vector<uint8_t> bytes(SPHC_SIGNATURE_BYTES + 1);
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  return bytes;
}

// The character at a place of UTF-8, and how many bytes it has; 0: it is none.
size_t readCharacter(const std::string &text, size_t at, uint32_t *character) {
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // of so many bytes
  const auto first = static_cast<uint8_t>(text[at]);
  const size_t bytes = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (bytes == 0 || at + bytes > text.size()) return 0;
  *character = bytes == 1 ? first : first & 0x7f >> bytes;
  for (size_t i = 1; i < bytes; ++i) {
    const auto next = static_cast<uint8_t>(text[at + i]);
    if (next >> 6 != 2) return 0;
    *character = *character << 6 | (next & 0x3f);
  }
  const bool is_surrogate = *character >= 0xd800 && *character < 0xe000;
  return *character < kLeast[bytes] || *character > 0x10ffff || is_surrogate ? 0 : bytes;
}

// Others would come out of JSON changed, or do something to a terminal.
bool canBeShown(const std::string &text) {
  uint32_t character = 0;
  for (size_t at = 0, bytes = 0; at < text.size(); at += bytes) {
    bytes = readCharacter(text, at, &character);
    if (bytes == 0 || character < 0x20 || (character >= 0x7f && character < 0xa0)) return false;
  }
  return true;
}

sphc_signature_policy policyOf(const Trust &trust) {
  sphc_signature_policy policy;
  sphc_signature_policy_init(&policy, sizeof policy);
  policy.keys = trust.keys.data();
  policy.key_count = static_cast<uint32_t>(trust.keys.size());
  policy.least_release = trust.least_release;
  policy.name = trust.name ? trust.name->c_str() : nullptr;
  return policy;
}

}  // namespace

void checkMapName(const std::string &name) {
  if (name.size() >= SPHC_SIGNATURE_NAME_BYTES) throw UsageError("--name: a name has at most 31 bytes");
  if (!canBeShown(name)) throw UsageError("--name: a name is text in UTF-8 without control characters");
}

Signature signMap(const void *map, size_t map_bytes, const SigningKey &key, uint64_t release,
                  const std::string &name) {
  checkMapName(name);
  sphc_statement statement = {};
  statement.release = release;
  statement.map_bytes = map_bytes;
  sphc_statement_key_id(key.publicKey().bytes, statement.key_id);
  std::copy(name.begin(), name.end(), statement.name);
  sphc_sha512(map, map_bytes, statement.map_sha512);
  Signature made;
  sphc_statement_write(&statement, made.data());
  const auto signature = key.sign(made.data(), SPHC_STATEMENT_BYTES);
  std::copy(signature.begin(), signature.end(), made.begin() + SPHC_STATEMENT_BYTES);
  return made;
}

sphc_signature_statement checkSignature(const Trust &trust, const std::string &map, const void *bytes,
                                        size_t count) {
  const std::string signature_path = trust.signature.empty() ? signaturePath(map) : trust.signature;
  const sphc_signature_policy policy = policyOf(trust);
  checkIsFile(signature_path, "the signature that spherecloud sign wrote beside the map");
  const std::vector<uint8_t> signature = readSignature(signature_path);
  sphc_signature_statement statement = {};
  statement.struct_size = sizeof statement;
  sphc_message message = {};
  const sphc_status status =
      sphc_signature_verify(&policy, bytes, count, signature.data(), signature.size(), &statement, &message);
  if (status == SPHC_OK) return statement;
  throw std::runtime_error("cannot use the map " + map + " with the signature " + signature_path + ": " +
                           message.text + " [" + sphc_signature_status_name(status) + "]");
}

std::optional<Stated> statedBy(const sphc_signature_key &key, const std::string &signature_path) {
  std::error_code absent;
  if (!std::filesystem::is_regular_file(signature_path, absent)) return std::nullopt;
  const std::vector<uint8_t> bytes = readSignature(signature_path);
  sphc_statement statement;
  if (bytes.size() != SPHC_SIGNATURE_BYTES || !sphc_statement_read(bytes.data(), &statement)) return std::nullopt;
  uint8_t id[SPHC_KEY_ID_BYTES];
  sphc_statement_key_id(key.bytes, id);
  if (!std::equal(id, id + sizeof id, statement.key_id)) return std::nullopt;
  Stated stated = {statement.release, statement.name};
  std::copy(statement.map_sha512, statement.map_sha512 + SPHC_SHA512_BYTES, stated.map_sha512.begin());
  return stated;
}

bool Stated::isOf(const void *map, size_t map_bytes) const {
  std::array<uint8_t, SPHC_SHA512_BYTES> hash;
  sphc_sha512(map, map_bytes, hash.data());
  return hash == map_sha512;
}

}  // namespace sphc::host
