// A signed map that never changes, for tests of verifiers: nothing here signs. tests/unit/signature/sodium_test.cpp
// holds it against libsodium.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "spherecloud/spherecloud_signature.h"
#include "tests/support/hex_bytes.h"
#include "tests/support/map_bytes.h"

namespace sphc::test {

inline sphc_signature_key keyOfHex(const std::string &text) {
  sphc_signature_key key = {};
  const std::vector<uint8_t> bytes = bytesOfHex(text);
  std::copy(bytes.begin(), bytes.end(), key.bytes);
  return key;
}

// RFC 8032, section 7.1, tests 1 and 2: secret seeds and public keys.
constexpr char kSeed[] = "9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60";
constexpr char kKey[] = "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a";
constexpr char kOtherKey[] = "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c";

inline std::vector<uint8_t> goldenMap() { return randomMap(16, 3); }
constexpr uint64_t kGoldenRelease = 7;
constexpr char kGoldenName[] = "kitchen";
// Of goldenMap, by kKey.
constexpr char kGoldenSignature[] =
    "535048455245434c4f55442d534947310700000000000000800e0000000000000e02a50225b4baaa18a0470ed9bfc7dc6b697463"
    "68656e00000000000000000000000000000000000000000000000000091b9e8085344d043b1bd95798aff398d806a6c2902e9578"
    "c0be21765b4946dd8915ad8e1436c8b70d38827289cbeb1f8f962005495bcee55f74af250098edea956adee9e75174c62dc0b5e4"
    "3aae93fc00b9886e99bca154d338aa32a3c3e0b70f30035a95655fc032813e861b6dbb55222792665f4064f1ab0bfef527fdd402";

}  // namespace sphc::test
