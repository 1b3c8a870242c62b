#include <cstring>
#include <stdexcept>

#include "host/import/model_file.h"
#include "runtime/map/crc32.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

constexpr size_t kCrcAt = 28;

void readAgain(const std::vector<uint8_t> &file) {
  try {
    if (host::encodeModel(host::decodeModel(file)) != file) broken("a model that is read is written as it was");
    accept();
  } catch (const std::runtime_error &error) {
    if (!*error.what()) broken("a refusal explains itself");
  }
}

}  // namespace

void pointModel(const uint8_t *data, size_t bytes) {
  std::vector<uint8_t> file(data, data + bytes);
  readAgain(file);
  if (bytes < kCrcAt + sizeof(uint32_t)) return;
  // With the right checksum, so that what stands behind it is reached.
  std::memset(&file[kCrcAt], 0, sizeof(uint32_t));
  const uint32_t crc = crc32(0, file.data(), file.size());
  std::memcpy(&file[kCrcAt], &crc, sizeof crc);
  readAgain(file);
}

}  // namespace sphc::fuzz
