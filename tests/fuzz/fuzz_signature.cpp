#include <algorithm>
#include <cstring>
#include <memory>

#include "spherecloud/spherecloud_signature.h"
#include "tests/fuzz/targets.h"
#include "tests/support/golden_signature.h"

namespace sphc::fuzz {

void signature(const uint8_t *data, size_t bytes) {
  static const std::vector<uint8_t> golden_map = test::goldenMap(),
                                    golden = test::bytesOfHex(test::kGoldenSignature);
  static const sphc_signature_key keys[] = {test::keyOfHex(test::kOtherKey), test::keyOfHex(test::kKey)};
  // Exactly as many bytes as there are, so that a sanitizer sees a step too far.
  const size_t signature_bytes = std::min<size_t>(bytes, SPHC_SIGNATURE_BYTES), map_bytes = bytes - signature_bytes;
  const std::unique_ptr<uint8_t[]> signature(new uint8_t[signature_bytes]), map(new uint8_t[map_bytes]);
  std::copy_n(data, signature_bytes, signature.get());
  std::copy_n(data + signature_bytes, map_bytes, map.get());

  sphc_signature_policy policy;
  sphc_signature_policy_init(&policy, sizeof policy);
  policy.keys = keys;
  policy.key_count = 2;
  sphc_signature_statement said = {};
  said.struct_size = sizeof said;
  sphc_message message = {};
  const sphc_status status =
      sphc_signature_verify(&policy, map.get(), map_bytes, signature.get(), signature_bytes, &said, &message);
  const bool is_golden = signature_bytes == golden.size() && map_bytes == golden_map.size() &&
                         std::equal(golden.begin(), golden.end(), signature.get()) &&
                         std::equal(golden_map.begin(), golden_map.end(), map.get());
  if ((status == SPHC_OK) != is_golden) broken("the golden map is accepted, and nothing else");
  if (status == SPHC_OK) {
    accept();
    if (said.release != test::kGoldenRelease || said.key_index != 1)
      broken("an accepted map tells what was signed");
  } else if (status > SPHC_E_SIGNATURE_MISSING || status < SPHC_E_SIGNATURE_RELEASE || !message.text[0] ||
             said.release != 0) {
    broken("a refusal is a failure that explains itself");
  }
}

}  // namespace sphc::fuzz
