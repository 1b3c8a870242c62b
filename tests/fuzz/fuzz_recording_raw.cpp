#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "drivers/raw/raw.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

constexpr size_t kHeaderBytes = 320, kHeadBytes = 88, kMostMemory = 1 << 20;

int readBytes(void *user, uint64_t offset, void *out, size_t bytes) {
  const auto &all = *static_cast<const std::vector<uint8_t> *>(user);
  if (offset > all.size() || bytes > all.size() - offset) return 1;
  std::memcpy(out, all.data() + offset, bytes);
  return 0;
}

// The last four of `bytes` bytes become the CRC of those before.
void repair(uint8_t *data, size_t bytes) {
  const auto crc = static_cast<uint32_t>(crc32_z(0, data, bytes - 4));
  for (size_t i = 0; i < 4; ++i) data[bytes - 4 + i] = static_cast<uint8_t>(crc >> (8 * i));
}

void readFrame(const sphc_raw &raw, uint32_t index, std::vector<uint8_t> *memory) {
  sphc_raw_frame recorded;
  sphc_message message = {};
  const sphc_status status = sphc_raw_read_frame(&raw, index, memory->data(), raw.frame_bytes, &recorded, &message);
  if (status != SPHC_OK && !message.text[0]) broken("a frame is read, or the failure explains itself");
  if (status != SPHC_OK) return;
  const sphc_image &color = recorded.frame.color;
  const auto *end = static_cast<const uint8_t *>(color.data) + size_t{color.stride_bytes} * color.height;
  if (end != memory->data() + raw.frame_bytes) broken("the images fill the memory that was asked for");
  accept();
}

}  // namespace

void rawRecording(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  std::vector<uint8_t> file(data + 1, data + bytes);
  const bool repairs = data[0] % 2 == 0;  // else nothing behind a checksum would ever be seen
  if (repairs && file.size() >= kHeaderBytes) repair(file.data(), kHeaderBytes);
  sphc_raw raw;
  sphc_message message = {};
  if (sphc_raw_open(&raw, readBytes, &file, file.size(), &message) != SPHC_OK) {
    if (!message.text[0]) broken("a refusal explains itself");
    return;
  }
  if (raw.frame_bytes > kMostMemory) return;
  std::vector<uint8_t> memory(raw.frame_bytes);
  for (uint32_t i = 0; i < std::min(raw.frame_count, 4u); ++i) {
    if (repairs) repair(file.data() + kHeaderBytes + i * raw.frame_bytes, kHeadBytes);
    readFrame(raw, i, &memory);
  }
}

}  // namespace sphc::fuzz
