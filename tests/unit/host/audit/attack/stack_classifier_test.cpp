#include "host/audit/attack/stack_classifier.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/audit/attack/mlp.h"
#include "host/audit/attack/stack_features.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

const std::string kModel = std::string(SPHC_NETWORKS) + "/stacks_patchwork.json";

struct Golden {
  Published map;
  Eigen::MatrixXf features;
};

// As golden() of train/real_or_fake/stack_network.py.
Golden goldenStack() {
  Golden golden = {{}, Eigen::MatrixXf(40, kStackFeatures)};
  for (int i = 0; i < 40; ++i) {
    golden.map.directions.push_back(Vector3(i * 37 % 40 / 400.0, i * 11 % 40 / 400.0, 1).normalized());
    Descriptor descriptor;
    for (int k = 0; k < 128; ++k) descriptor.bytes[k] = static_cast<uint8_t>((i * 7 + k * 13) % 120);
    golden.map.descriptors.push_back(descriptor);
    for (int c = 0; c < kStackFeatures; ++c) golden.features(i, c) = static_cast<float>((i * 5 + c * 3) % 17) / 4;
  }
  return golden;
}

TEST(StackClassifier, SaysWhatItSaidWhereItWasTrained) {
  const Golden golden = goldenStack();
  const Eigen::ArrayXf logits =
      StackClassifier(kModel).logits(golden.map, std::vector<uint32_t>(40), golden.features);
  std::ifstream file(std::string(SPHC_GOLDEN) + "/stacks_golden.csv");
  float expected;
  for (Eigen::Index i = 0; i < 40; ++i) {
    ASSERT_TRUE(file >> expected);
    EXPECT_NEAR(logits[i], expected, 2e-3f) << i;
  }
  EXPECT_GT(logits.maxCoeff() - logits.minCoeff(), 0.1f);
}

TEST(StackClassifier, OtherStacksDoNotMatterAndCompanyDoes) {
  const StackClassifier classifier(kModel);
  const Golden golden = goldenStack();
  const std::vector<uint32_t> one(40);
  std::vector<uint32_t> two = one;
  std::fill(two.begin() + 20, two.end(), 1);
  const Eigen::ArrayXf together = classifier.logits(golden.map, one, golden.features);
  const Eigen::ArrayXf apart = classifier.logits(golden.map, two, golden.features);
  EXPECT_GT((together - apart).abs().maxCoeff(), 0.01f);
  Golden changed = golden;
  for (size_t i = 20; i < 40; ++i) changed.map.descriptors[i] = {};
  const Eigen::ArrayXf beside = classifier.logits(changed.map, two, changed.features);
  EXPECT_EQ((beside - apart).head(20).abs().maxCoeff(), 0);
  EXPECT_GT((beside - apart).tail(20).abs().maxCoeff(), 0.01f);
}

TEST(StackClassifier, OtherModelsAreRefused) {
  EXPECT_THROW(StackClassifier(std::string("/nowhere/model.json")), std::runtime_error);
  EXPECT_THROW(StackClassifier(std::string(SPHC_NETWORKS) + "/co_occurrence.json"), std::runtime_error);
  const test::TempFolder folder;
  const auto spoilt = [&folder](const char *pointer, const nlohmann::json &value) {
    nlohmann::json json = readModel(kModel, "spherecloud stacks 1");
    json[nlohmann::json::json_pointer(pointer)] = value;
    return folder.write("stacks.json", json.dump());
  };
  EXPECT_NO_THROW(StackClassifier(spoilt("/strategy", "any")));
  for (const char *pointer : {"/mean", "/looks_first", "/looks_second/weights", "/told/bias", "/blocks",
                              "/blocks/0/mix/scale", "/blocks/1/before_attention/gain", "/logit/weights/0"})
    for (const nlohmann::json &value : {nlohmann::json(), nlohmann::json(3), nlohmann::json::array({1, 2})})
      EXPECT_THROW(StackClassifier(spoilt(pointer, value)), std::runtime_error) << pointer << value;
  EXPECT_THROW(StackClassifier(spoilt("/blocks/0/of_distance/weights", {{1, 2, 3, 4, 5, 6}})), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
