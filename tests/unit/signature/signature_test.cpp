#include "spherecloud/spherecloud_signature.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "tests/support/golden_signature.h"

namespace sphc {
namespace {

// The golden map and its signature, under a policy that accepts them; each test spoils one thing.
class SignatureTest : public testing::Test {
 protected:
  SignatureTest() {
    EXPECT_EQ(sphc_signature_policy_init(&policy_, sizeof policy_), SPHC_OK);
    policy_.keys = keys_.data();
    policy_.key_count = 1;
  }

  sphc_status verify() {
    statement_ = {};
    statement_.struct_size = sizeof statement_;
    message_ = {};
    const sphc_status status = sphc_signature_verify(&policy_, map_.data(), map_.size(), signature_.data(),
                                                     signature_.size(), &statement_, &message_);
    EXPECT_EQ(status != SPHC_OK, message_.text[0] != '\0');
    EXPECT_EQ(statement_.release, status == SPHC_OK ? test::kGoldenRelease : 0)
        << "failure leaves outputs untouched";
    return status;
  }

  std::string told() const { return message_.text; }

  sphc_status open(sphc_map **map) {
    return sphc_signature_open_map(&policy_, memory_, sizeof memory_, map_.data(), map_.size(), signature_.data(),
                                   signature_.size(), map, &statement_, &message_);
  }

  std::vector<uint8_t> map_ = test::goldenMap(), signature_ = test::bytesOfHex(test::kGoldenSignature);
  std::vector<sphc_signature_key> keys_ = {test::keyOfHex(test::kKey), test::keyOfHex(test::kOtherKey)};
  sphc_signature_policy policy_;
  sphc_signature_statement statement_ = {};
  sphc_message message_ = {};
  alignas(64) uint8_t memory_[SPHC_MAP_BYTES_MAX];
};

TEST_F(SignatureTest, ASignedMapIsAccepted) {
  ASSERT_EQ(verify(), SPHC_OK);
  EXPECT_EQ(statement_.release, test::kGoldenRelease);
  EXPECT_EQ(statement_.key_index, 0u);
  EXPECT_STREQ(statement_.name, test::kGoldenName);
  EXPECT_EQ(sphc_signature_verify(&policy_, map_.data(), map_.size(), signature_.data(), signature_.size(), nullptr,
                                  nullptr),
            SPHC_OK);
}

TEST_F(SignatureTest, AnUnsignedMapIsRefused) {
  signature_.clear();
  EXPECT_EQ(verify(), SPHC_E_SIGNATURE_MISSING);
  EXPECT_NE(told().find("spherecloud sign"), std::string::npos);
}

TEST_F(SignatureTest, AnyOtherLengthIsRefused) {
  for (const size_t bytes : {size_t{1}, size_t{64}, size_t{207}, size_t{209}}) {
    signature_.resize(bytes);
    EXPECT_EQ(verify(), SPHC_E_SIGNATURE_FORMAT) << bytes;
  }
}

TEST_F(SignatureTest, EveryPartOfTheSignatureCounts) {
  for (size_t bit = 0; bit < 8 * signature_.size(); bit += 7) {
    signature_[bit / 8] = static_cast<uint8_t>(signature_[bit / 8] ^ 1u << bit % 8);
    const sphc_status status = verify();
    const size_t byte = bit / 8;
    if (byte < 16)
      EXPECT_EQ(status, SPHC_E_SIGNATURE_FORMAT) << bit;
    else if (byte >= 32 && byte < 48)
      EXPECT_EQ(status, SPHC_E_SIGNATURE_KEY) << bit;
    else if (byte >= 48 && byte < 80)
      EXPECT_TRUE(status == SPHC_E_SIGNATURE_FORGED || status == SPHC_E_SIGNATURE_FORMAT) << bit;
    else
      EXPECT_EQ(status, SPHC_E_SIGNATURE_FORGED) << bit;
    signature_[bit / 8] = static_cast<uint8_t>(signature_[bit / 8] ^ 1u << bit % 8);
  }
}

TEST_F(SignatureTest, EveryPartOfTheMapCounts) {
  for (size_t byte = 0; byte < map_.size(); byte += 37) {
    map_[byte] ^= 0x10;
    EXPECT_EQ(verify(), SPHC_E_SIGNATURE_MAP) << byte;
    map_[byte] ^= 0x10;
  }
  map_.push_back(0);
  EXPECT_EQ(verify(), SPHC_E_SIGNATURE_MAP);
  map_.resize(map_.size() - 2);
  EXPECT_EQ(verify(), SPHC_E_SIGNATURE_MAP);
}

TEST_F(SignatureTest, AnotherKeyIsRefused) {
  policy_.keys = &keys_[1];
  EXPECT_EQ(verify(), SPHC_E_SIGNATURE_KEY);
}

// While keys change, devices trust the old one and the new one.
TEST_F(SignatureTest, AnyKeyOfTheListWillDo) {
  policy_.key_count = 2;
  EXPECT_EQ(verify(), SPHC_OK);
  std::swap(keys_[0], keys_[1]);
  ASSERT_EQ(verify(), SPHC_OK);
  EXPECT_EQ(statement_.key_index, 1u);
}

TEST_F(SignatureTest, AnOlderReleaseIsRefused) {
  policy_.least_release = test::kGoldenRelease;
  EXPECT_EQ(verify(), SPHC_OK);
  policy_.least_release = test::kGoldenRelease + 1;
  EXPECT_EQ(verify(), SPHC_E_SIGNATURE_RELEASE);
}

TEST_F(SignatureTest, AnotherNameIsRefused) {
  policy_.name = test::kGoldenName;
  EXPECT_EQ(verify(), SPHC_OK);
  for (const char *name : {"", "kitche", "kitchens", "hall"}) {
    policy_.name = name;
    EXPECT_EQ(verify(), SPHC_E_SIGNATURE_NAME) << name;
  }
}

TEST_F(SignatureTest, APolicyThatTrustsNobodyOrAnybodyIsAnError) {
  policy_.key_count = 0;
  EXPECT_EQ(verify(), SPHC_E_ARGUMENT);
  policy_.key_count = SPHC_SIGNATURE_KEYS_MAX + 1;
  EXPECT_EQ(verify(), SPHC_E_ARGUMENT);
  policy_.key_count = 2;
  keys_[1] = {};  // as where the list was not filled
  EXPECT_EQ(verify(), SPHC_E_ARGUMENT);
  policy_.keys = nullptr;
  EXPECT_EQ(verify(), SPHC_E_ARGUMENT);
}

TEST_F(SignatureTest, WrongArgumentsAreErrors) {
  const std::string name(SPHC_SIGNATURE_NAME_BYTES, 'x');
  policy_.name = name.c_str();
  EXPECT_EQ(verify(), SPHC_E_ARGUMENT);
  policy_.name = nullptr;
  policy_.struct_size = 0;
  EXPECT_EQ(verify(), SPHC_E_STRUCT_SIZE);
  policy_.struct_size = sizeof policy_;
  sphc_signature_statement statement = {};
  EXPECT_EQ(sphc_signature_verify(&policy_, map_.data(), map_.size(), signature_.data(), signature_.size(),
                                  &statement, nullptr),
            SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_signature_verify(&policy_, nullptr, 0, signature_.data(), signature_.size(), nullptr, nullptr),
            SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_signature_verify(nullptr, map_.data(), map_.size(), signature_.data(), signature_.size(), nullptr,
                                  nullptr),
            SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_signature_policy_init(nullptr, sizeof policy_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_signature_policy_init(&policy_, sizeof policy_ + 1), SPHC_E_STRUCT_SIZE);
}

TEST_F(SignatureTest, AnAcceptedMapIsOpened) {
  statement_.struct_size = sizeof statement_;
  sphc_map *map = nullptr;
  ASSERT_EQ(open(&map), SPHC_OK) << message_.text;
  EXPECT_EQ(statement_.release, test::kGoldenRelease);
  sphc_map_info info = {};
  info.struct_size = sizeof info;
  ASSERT_EQ(sphc_map_get_info(map, &info), SPHC_OK);
  EXPECT_EQ(info.file_bytes, map_.size());
  sphc_map_fini(&map);
}

TEST_F(SignatureTest, ARefusedMapIsNotOpened) {
  statement_.struct_size = sizeof statement_;
  map_[64] ^= 1;
  sphc_map *map = nullptr;
  EXPECT_EQ(open(&map), SPHC_E_SIGNATURE_MAP);
  EXPECT_EQ(map, nullptr);
  EXPECT_EQ(statement_.release, 0u);
  signature_.clear();
  EXPECT_EQ(open(&map), SPHC_E_SIGNATURE_MISSING);
  EXPECT_EQ(map, nullptr);
}

// What the map's reader refuses stays refused, and tells nothing of the signature.
TEST_F(SignatureTest, ASignatureMakesNoMapValid) {
  statement_.struct_size = sizeof statement_;
  sphc_map *map = nullptr;
  EXPECT_EQ(sphc_signature_open_map(&policy_, memory_, 1, map_.data(), map_.size(), signature_.data(),
                                    signature_.size(), &map, &statement_, &message_),
            SPHC_E_MEMORY_SIZE);
  EXPECT_EQ(map, nullptr);
  EXPECT_EQ(statement_.release, 0u);
}

TEST(SignatureNames, EveryStatusHasOne) {
  for (sphc_status status = SPHC_E_SIGNATURE_RELEASE; status <= SPHC_E_SIGNATURE_MISSING; ++status)
    EXPECT_EQ(std::string(sphc_signature_status_name(status)).find("SPHC_E_SIGNATURE_"), 0u) << status;
  EXPECT_STREQ(sphc_signature_status_name(SPHC_E_MAP_FORMAT), "SPHC_E_MAP_FORMAT");
  EXPECT_STREQ(sphc_signature_status_name(SPHC_E_SIGNATURE_RELEASE - 1), "SPHC_?");
}

// Its numbers are free in spherecloud.h, and stay so.
TEST(SignatureNames, NoneIsOfTheOtherHeader) {
  for (sphc_status status = -69; status <= -60; ++status)
    EXPECT_STREQ(sphc_status_name(status), "SPHC_?") << status;
}

}  // namespace
}  // namespace sphc
