// Bytes that Apple's own encoder of LZFSE made (lzfse 1.0), and bytes in a block that holds them as they are.
#pragma once

#include <string>

#include "host/recording/mcap/bytes.h"
#include "tests/support/hex_bytes.h"

namespace sphc::test {

constexpr uint32_t kLzfseCols = 36, kLzfseRows = 48;

// What the samples are of: metres as floats, and ARKit's confidence.
inline uint32_t lzfseSampleMm(uint32_t x, uint32_t y) { return 1000 + 8 * ((x / 3 + y / 4) % 16) + x * y % 3; }
inline uint32_t lzfseSampleConfidence(uint32_t y) { return y / 16; }

// A block of the kind bvx2.
constexpr const char *kLzfseDepth =
    "62767832001b0000d800c00a007f0070030810a840eb0070c9000000365c50039f005707b201020020a0c7780037005cf314044e0000"
    "00803701086f0400003c01670000000000009c71c10517002c16175c00b0002e2ed602d6c5c5e28c0b16b0b86571c102164f0617eb62"
    "5db0385b1717179cb15870c119b79cb158c005b75c70c1828bb52e800b1670717171717171717171767671717b717bfb005cdc72c182"
    "8b05c002582c000016172c002e38030080c5051700005cb00080c519000017b0b8000060710100000040487a1b993a9a7bbb03f64185"
    "f77617df83259b971994c8416db35fa33af5f960ad5047bf17ed568f783dd09d33df33a30f132a6b3de407f1b599b89d57e23e0bb170"
    "a8a31010326d9f682373f9b78c6ef7c4b848d6e7f3015edb97681fa68810b5f321c1052b66151f61c432340ce4067eeaafc238daa193"
    "d298cf6a8d5f99bee6c7c0737db92958e91b1c84247a2e32aeec89ff20d24f804c71782793f54a39195a4fe08da23641ca0000000000"
    "0000000000b42ab080a1330d550c8d4954351426d36109cb073ad3a8e0684c42554361121d96583ed199860a86c62454350a93e9b084"
    "e5039d69a8603426a3aaa130890e4b583ee84c4705436312aa1a0a937458c6f281ce345430342651d551984487252c1fe84ca382a331"
    "09550d85497458fa391ac9b4860a1a89f4f5a198a0a71a6d614723917a99091453888b62323d55a8096e8b62a2baa28842de8bca147a"
    "acc0311ac9b4840a1a89f4f5a198a0a71a6d61c751aa6011371a840d07698341dc6810361ca40d06710bbee37e723e399f9c4f8efa18"
    "502391c64747474747474747bad162767824";

// One of the kind bvxn.
constexpr const char *kLzfseConfidence =
    "6276786ec006000024000000680100f0fff0fff0096e01f0fff0fff0096e02f0fff0fff007e20202060000000000000062767824";

inline recording::Bytes lzfseDepth() { return bytesOfHex(kLzfseDepth); }
inline recording::Bytes lzfseConfidence() { return bytesOfHex(kLzfseConfidence); }

inline recording::Bytes lzfseStored(const recording::Bytes &bytes) {
  recording::Bytes out;
  recording::append(out, "bvx-", 4);
  recording::putLittle(out, static_cast<uint32_t>(bytes.size()));
  recording::append(out, bytes.data(), bytes.size());
  recording::append(out, "bvx$", 4);
  return out;
}

}  // namespace sphc::test
