#include "signature/statement.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/golden_signature.h"

namespace sphc {
namespace {

TEST(Statement, IsReadAsItWasWritten) {
  const std::vector<uint8_t> golden = test::bytesOfHex(test::kGoldenSignature);
  sphc_statement statement = {};
  ASSERT_EQ(sphc_statement_read(golden.data(), &statement), 1);
  EXPECT_EQ(statement.release, test::kGoldenRelease);
  EXPECT_EQ(statement.map_bytes, test::goldenMap().size());
  EXPECT_STREQ(statement.name, test::kGoldenName);
  uint8_t key_id[SPHC_KEY_ID_BYTES];
  sphc_statement_key_id(test::keyOfHex(test::kKey).bytes, key_id);
  EXPECT_EQ(std::memcmp(key_id, statement.key_id, sizeof key_id), 0);
  uint8_t written[SPHC_STATEMENT_BYTES];
  sphc_statement_write(&statement, written);
  EXPECT_EQ(std::memcmp(written, golden.data(), sizeof written), 0);
}

TEST(Statement, AnotherTagIsNoStatement) {
  for (size_t i = 0; i < 16; ++i) {
    std::vector<uint8_t> bytes = test::bytesOfHex(test::kGoldenSignature);
    bytes[i] ^= 1;
    sphc_statement untouched = {};
    untouched.release = 99;
    EXPECT_EQ(sphc_statement_read(bytes.data(), &untouched), 0) << i;
    EXPECT_EQ(untouched.release, 99u);
  }
}

TEST(Statement, ANameEndsAndHidesNothing) {
  constexpr size_t kName = 48;
  std::vector<uint8_t> bytes = test::bytesOfHex(test::kGoldenSignature);
  sphc_statement statement = {};
  bytes[kName + 10] = 'x';  // behind the name's end
  EXPECT_EQ(sphc_statement_read(bytes.data(), &statement), 0);
  std::fill_n(bytes.begin() + kName, SPHC_SIGNATURE_NAME_BYTES, uint8_t{'x'});  // without an end
  EXPECT_EQ(sphc_statement_read(bytes.data(), &statement), 0);
  bytes[kName + SPHC_SIGNATURE_NAME_BYTES - 1] = 0;
  EXPECT_EQ(sphc_statement_read(bytes.data(), &statement), 1);
  std::fill_n(bytes.begin() + kName, SPHC_SIGNATURE_NAME_BYTES, uint8_t{0});  // without a name
  EXPECT_EQ(sphc_statement_read(bytes.data(), &statement), 1);
}

}  // namespace
}  // namespace sphc
