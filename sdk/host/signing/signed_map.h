// Signatures of map files: made by the owner, asked for by whoever uses a map.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/signing/key_file.h"
#include "signature/sha512.h"
#include "spherecloud/spherecloud_signature.h"

namespace sphc::host {

using Signature = std::array<uint8_t, SPHC_SIGNATURE_BYTES>;

// In what a signature file begins.
constexpr char kSignatureHead[] = "SPHERECLOUD-SIG1";
// Where it stands, unless something else is said.
inline std::string signaturePath(const std::string &map) { return map + ".sig"; }

// A name is UTF-8 of at most 31 bytes, without control characters; UsageError otherwise.
void checkMapName(const std::string &name);

// Throws as checkMapName does.
Signature signMap(const void *map, size_t map_bytes, const SigningKey &key, uint64_t release,
                  const std::string &name);

// Whom and what a user accepts; without keys, any map.
struct Trust {
  std::vector<sphc_signature_key> keys;
  uint64_t least_release = 0;
  std::optional<std::string> name;  // none: any; empty: only a map that was signed without one
  std::string signature;            // file; empty: signaturePath of the map
};

// Throws std::runtime_error with cause and cure unless the signature file makes the map one to accept.  `map` is
// the path of the map, whose bytes were read already.
sphc_signature_statement checkSignature(const Trust &trust, const std::string &map, const void *bytes,
                                        size_t count);

struct Stated {
  uint64_t release = 0;
  std::string name;
  std::array<uint8_t, SPHC_SHA512_BYTES> map_sha512 = {};
  bool isOf(const void *map, size_t map_bytes) const;
};
// What a signature file that is there says; nothing where there is none, or one by another key.
std::optional<Stated> statedBy(const sphc_signature_key &key, const std::string &signature_path);

}  // namespace sphc::host
