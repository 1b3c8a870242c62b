// An encrypted file that never changes, for tests of what decrypts: nothing here encrypts.
// tests/unit/encryption/sodium_test.cpp holds it against libsodium.
#pragma once
#include <numeric>
#include <string>

#include "spherecloud/spherecloud_encryption.h"
#include "tests/support/hex_bytes.h"

namespace sphc::test {

// draft-irtf-cfrg-xchacha-03, appendix A.3.1: key, nonce and text.
inline sphc_encryption_key goldenEncryptionKey() {
  sphc_encryption_key key;
  std::iota(key.bytes, key.bytes + sizeof key.bytes, uint8_t{0x80});
  return key;
}
constexpr char kGoldenText[] =
    "Ladies and Gentlemen of the class of '99: If I could offer you only one tip for the future, sunscreen would "
    "be it.";
// Its cipher text, which does not depend on the header; the tag of the draft is of another header.
constexpr char kGoldenEncrypted[] =
    "535048455245434c4f55442d454e433172000000000000007913a407b1901038c04b9c9334e0e5214041424344454647"
    "48494a4b4c4d4e4f5051525354555657bd6d179d3e83d43b9576579493c0e939572a1700252bfaccbed2902c21396cbb"
    "731c7f1b0b4aa6440bf3a82f4eda7e39ae64c6708c54c216cb96b72e1213b4522f8c9ba40db5d945b11b69b982c1bb9e"
    "3f3fac2bc369488f76b2383565d3fff921f9664c97637da9768812f615c68b13b52e44d6042212d37063cce5908a2a2a"
    "2510";

inline std::vector<uint8_t> goldenEncrypted() { return bytesOfHex(kGoldenEncrypted); }

}  // namespace sphc::test
