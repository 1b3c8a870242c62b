#include "encryption/poly1305.h"

#include <gtest/gtest.h>

#include "tests/support/hex_bytes.h"

namespace sphc {
namespace {

std::string tagOf(const std::string &r, const std::string &pad, const std::string &data) {
  const std::vector<uint8_t> key = test::bytesOfHex(r + pad), bytes = test::bytesOfHex(data);
  sphc_poly1305 state;
  sphc_poly1305_init(&state, key.data());
  sphc_poly1305_add_padded(&state, bytes.data(), bytes.size());
  uint8_t tag[16];
  sphc_poly1305_tag(&state, tag);
  std::string text;
  for (const uint8_t byte : tag) text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
  return text;
}

std::string zeroes(size_t bytes) { return std::string(2 * bytes, '0'); }
std::string ones(size_t bytes) { return std::string(2 * bytes, 'f'); }

// RFC 8439, appendix A.3: sums at the edge of the modulus.
TEST(Poly1305, SumsAreReduced) {
  EXPECT_EQ(tagOf("02" + zeroes(15), zeroes(16), ones(16)), "03" + zeroes(15));
  EXPECT_EQ(tagOf("02" + zeroes(15), ones(16), "02" + zeroes(15)), "03" + zeroes(15));
  EXPECT_EQ(tagOf("01" + zeroes(15), zeroes(16), ones(16) + "f0" + ones(15) + "11" + zeroes(15)),
            "05" + zeroes(15));
  EXPECT_EQ(tagOf("01" + zeroes(15), zeroes(16),
                  ones(16) + "fbfefefefefefefefefefefefefefefe" +
                      "0101010101010101"
                      "0101010101010101"),
            zeroes(16));
  EXPECT_EQ(tagOf("02" + zeroes(15), zeroes(16), "fd" + ones(15)), "fa" + ones(15));
  EXPECT_EQ(tagOf("01" + zeroes(7) + "04" + zeroes(7), zeroes(16),
                  "e33594d7505e43b900000000000000003394d7505e4379cd01" + zeroes(23) + "01" + zeroes(15)),
            "14" + zeroes(7) + "55" + zeroes(7));
  EXPECT_EQ(tagOf("01" + zeroes(7) + "04" + zeroes(7), zeroes(16),
                  "e33594d7505e43b900000000000000003394d7505e4379cd01" + zeroes(23)),
            "13" + zeroes(15));
}

TEST(Poly1305, ABlockIsFilledWithZeroes) {
  const std::string r = "85d6be7857556d337f4452fe42d506a8", pad = "0103808afb0db2fd4abff6af4149f51b";
  EXPECT_EQ(tagOf(r, pad, "414243"), tagOf(r, pad, "414243" + zeroes(13)));
  EXPECT_NE(tagOf(r, pad, "414243"), tagOf(r, pad, "414243" + zeroes(14)));
  EXPECT_EQ(tagOf(r, pad, ""), pad);
}

}  // namespace
}  // namespace sphc
