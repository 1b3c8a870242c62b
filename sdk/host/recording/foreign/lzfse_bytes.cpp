#include "host/recording/foreign/lzfse_bytes.h"

#include <algorithm>

#include "host/recording/failure.h"

extern "C" {
#include "third_party/lzfse/lzfse.h"
}

namespace sphc::recording {

void decodeLzfse(ByteView compressed, size_t most_bytes, Bytes &out) {
  // It reads eight bytes at a time: of damaged bytes past their end, and of literals past the scratch memory's.
  constexpr size_t kPast = 64;
  Bytes padded(compressed.size + kPast);
  std::copy_n(compressed.data, compressed.size, padded.begin());
  std::vector<uint64_t> scratch((lzfse_decode_scratch_size() + kPast) / sizeof(uint64_t) + 1);
  out.resize(most_bytes + 1);  // what is more fills it
  const size_t size = lzfse_decode_buffer(out.data(), out.size(), padded.data(), compressed.size, scratch.data());
  if (size == 0) throw Failure(SPHC_E_DEVICE, "cannot be decoded as LZFSE; copy the file again");
  if (size > most_bytes)
    throw Failure(SPHC_E_IMAGE, "is of more than " + std::to_string(most_bytes) +
                                    " bytes, which its image has at most; use this recording's calibration");
  out.resize(size);
}

}  // namespace sphc::recording
