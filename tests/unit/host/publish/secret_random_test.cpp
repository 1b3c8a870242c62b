#include "host/publish/secret_random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

std::string keyPath(const char *name) {
  return testing::TempDir() + "sphc_key_" + std::to_string(getpid()) + "_" + name;
}

void write(const std::string &path, const std::string &text) {
  std::ofstream(path, std::ios::binary) << text;
  chmod(path.c_str(), 0600);
}

TEST(SecretRandom, SameKeySameStreamOtherKeyOther) {
  SecretKey key = {1, 2, 3}, other = key;
  other[31] = 1;
  SecretRandom a(key), b(key), c(other);
  int equal = 0;
  for (int i = 0; i < 2000; ++i) {  // across several refills
    const uint64_t value = a.next();
    ASSERT_EQ(value, b.next());
    equal += value == c.next();
  }
  EXPECT_EQ(equal, 0);
}

TEST(SecretRandom, BlocksDoNotRepeat) {
  SecretRandom random({});
  std::set<uint64_t> seen;
  for (int i = 0; i < 5000; ++i) seen.insert(random.next());
  EXPECT_EQ(seen.size(), 5000u);
}

TEST(SecretRandom, BelowIsEven) {
  SecretRandom random({9});
  std::vector<int> count(10);
  for (int i = 0; i < 100000; ++i) ++count[random.below(10)];
  for (int c : count) EXPECT_NEAR(c, 10000, 500);
  EXPECT_EQ(random.below(1), 0u);
}

TEST(SecretRandom, NormalHasMeanZeroAndVarianceOne) {
  SecretRandom random({7});
  double sum = 0, squares = 0, fourth = 0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x, squares += x * x, fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.01);
  EXPECT_NEAR(squares / kDraws, 1, 0.02);
  EXPECT_NEAR(fourth / kDraws, 3, 0.15);
}

TEST(KeyedHash, EachKeyPurposeAndContentHasItsOwn) {
  const SecretKey key = {1}, other = {2};
  const auto hash = keyedHash(key, "a", {1, 2}, 32);
  EXPECT_EQ(hash, keyedHash(key, "a", {1, 2}, 32));
  EXPECT_NE(hash, keyedHash(other, "a", {1, 2}, 32));
  EXPECT_NE(hash, keyedHash(key, "b", {1, 2}, 32));
  EXPECT_NE(hash, keyedHash(key, "a", {1, 3}, 32));
  EXPECT_NE(hash, keyedHash(key, std::string("a\1", 2), {2}, 32));  // where the purpose ends counts
  EXPECT_EQ(keyedHash(key, "a", {}, 16).size(), 16u);
  EXPECT_THROW(keyedHash(key, "a", {}, 65), std::runtime_error);
  EXPECT_NE(derivedKey(key, "a"), derivedKey(key, "b"));
  EXPECT_NE(newSecretKey(), newSecretKey());
}

TEST(SecretKeyFile, EachFaultIsExplained) {
  const std::string path = keyPath("bad");
  const std::string digits(64, 'a');
  for (const std::string &text : {std::string(), std::string(63, 'a'), std::string(65, 'a'), std::string(66, 'a'),
                                  std::string(64, 'g'), std::string(64, '0'), digits + " " + digits,
                                  digits + "\nmore", "0x" + digits, digits + std::string(300, ' ') + "more"}) {
    write(path, text);
    EXPECT_THAT(test::refusal([&] { readSecretKey(path); }), testing::HasSubstr(path)) << text;
  }
  write(path, digits + "\n");
  EXPECT_EQ(readSecretKey(path)[0], 0xAA);
  write(path, " \t\r\n" + digits + std::string(100, '\n'));
  EXPECT_EQ(readSecretKey(path)[31], 0xAA);
  for (const mode_t mode : {mode_t{0640}, mode_t{0604}}) {
    chmod(path.c_str(), mode);
    EXPECT_THAT(test::refusal([&] { readSecretKey(path); }), testing::HasSubstr("chmod 600 " + path));
  }
  unlink(path.c_str());
  EXPECT_THROW(readSecretKey(path), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
