#include "host/cli/common/choices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sphc::host {
namespace {

enum class Fruit { kApple = 3, kPear = 5 };

class ChoicesTest : public testing::Test {
 protected:
  ChoicesTest() {
    app_.add_option("--fruit", fruit_, "")
        ->transform(oneOf<Fruit>({{"apple", Fruit::kApple}, {"pear", Fruit::kPear}}));
  }
  CLI::App app_;
  Fruit fruit_ = Fruit::kApple;
};

TEST_F(ChoicesTest, ANameIsItsValue) {
  app_.parse("--fruit pear");
  EXPECT_EQ(fruit_, Fruit::kPear);
}

TEST_F(ChoicesTest, AnythingElseIsRefusedByName) {
  for (const std::string wrong : {"plum", "5", "Pear", "pea"}) {
    try {
      app_.parse("--fruit " + wrong);
      ADD_FAILURE() << wrong;
    } catch (const CLI::ParseError &error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("'" + wrong + "' is unknown; give one of apple, pear"));
    }
  }
}

}  // namespace
}  // namespace sphc::host
