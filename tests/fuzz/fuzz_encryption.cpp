#include <algorithm>
#include <memory>

#include "spherecloud/spherecloud_encryption.h"
#include "tests/fuzz/targets.h"
#include "tests/support/golden_encryption.h"

namespace sphc::fuzz {

void encryption(const uint8_t *data, size_t bytes) {
  static const std::vector<uint8_t> golden = test::goldenEncrypted();
  static const sphc_encryption_key key = test::goldenEncryptionKey();
  // Exactly as many bytes as there are, so that a sanitizer sees a step too far.
  const size_t map_bytes = std::max<size_t>(bytes, SPHC_ENCRYPTION_ADDED_BYTES) - SPHC_ENCRYPTION_ADDED_BYTES;
  const std::unique_ptr<uint8_t[]> file(new uint8_t[bytes]), map(new uint8_t[map_bytes]());
  std::copy_n(data, bytes, file.get());
  sphc_message message = {};
  const sphc_status status = sphc_encryption_decrypt(&key, file.get(), bytes, map.get(), map_bytes, &message);
  const bool is_golden = bytes == golden.size() && std::equal(golden.begin(), golden.end(), file.get());
  if ((status == SPHC_OK) != is_golden) broken("the golden file is decrypted, and nothing else");
  if (status == SPHC_OK) {
    accept();
    if (!std::equal(map.get(), map.get() + map_bytes, test::kGoldenText)) broken("it is decrypted to its text");
  } else if (status > SPHC_E_ENCRYPTION_FORMAT || status < SPHC_E_ENCRYPTION_CHANGED || !message.text[0] ||
             std::any_of(map.get(), map.get() + map_bytes, [](uint8_t byte) { return byte != 0; })) {
    broken("a refusal explains itself and writes nothing");
  }
}

}  // namespace sphc::fuzz
