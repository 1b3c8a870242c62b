#include "host/signing/signed_map.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
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

// Others would come out of JSON changed, or do something to a terminal.
bool canBeShown(const std::string &text) {
  const auto byte = [&text](size_t at) { return static_cast<uint8_t>(text[at]); };
  for (size_t i = 0; i < text.size(); ++i) {
    const bool is_two_byte_control = byte(i) == 0xC2 && i + 1 < text.size() && byte(i + 1) < 0xA0;
    if (byte(i) < ' ' || byte(i) == 0x7F || is_two_byte_control) return false;
  }
  try {
    nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error &) {  // no UTF-8
    return false;
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
