#include "host/audit/attack/real_or_fake.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/audit/attack/mirror.h"
#include "host/audit/score/auc.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/audit/made_up_cloud.h"

namespace sphc::host {
namespace {

const char kNetworks[] = SPHC_NETWORKS;

double aucOf(const std::vector<RealOrFakeGuess> &guesses, const std::string &attacker,
             const std::vector<bool> &real) {
  for (const RealOrFakeGuess &guess : guesses)
    if (guess.attacker == attacker) return areaUnderCurve(guess.scores, real).value;
  ADD_FAILURE() << "no attacker " << attacker;
  return 0;
}

TEST(RealOrFake, FakesThatLieAnywhereAreFound) {
  const KnownCloud cloud = makeUpCloud(true, 5);
  const auto guesses = guessRealOrFake(cloud.published, kNetworks);
  EXPECT_GT(aucOf(guesses, "density", cloud.real), 0.85);
  EXPECT_GT(aucOf(guesses, "lookalikes", cloud.real), 0.9);
  EXPECT_GT(aucOf(guesses, "knows gaussian", cloud.real), 0.8);
}

TEST(RealOrFake, FakesLikeRealPointsAreNot) {
  const KnownCloud cloud = makeUpCloud(false, 6);
  for (const RealOrFakeGuess &guess : guessRealOrFake(cloud.published, kNetworks)) {
    ASSERT_EQ(guess.scores.size(), cloud.real.size());
    const Auc auc = areaUnderCurve(guess.scores, cloud.real);
    EXPECT_NEAR(auc.value, 0.5, 4 * auc.standard_error) << guess.attacker;
  }
}

TEST(RealOrFake, MirroredFakesAreFoundAmongTheirLike) {
  Random random(7);
  Published published;
  std::vector<bool> real;
  for (int thing = 0; thing < 40; ++thing) {  // each seen once as it is, twice in the mirror
    const Descriptor common = test::randomDescriptor(&random);
    for (int copy = 0; copy < 3; ++copy) {
      const Descriptor seen = nearTo(common, &random);
      published.directions.push_back(test::randomDirection(&random));
      published.descriptors.push_back(copy == 0 ? seen : mirrorOf(seen));
      real.push_back(copy == 0);
    }
  }
  EXPECT_GT(aucOf(guessRealOrFake(published, kNetworks), "mirror", real), 0.95);
}

TEST(RealOrFake, ProbabilitiesAreProbabilitiesAndTheSameAgain) {
  const KnownCloud cloud = makeUpCloud(true, 8);
  const auto once = guessRealOrFake(cloud.published, kNetworks),
             again = guessRealOrFake(cloud.published, kNetworks);
  for (size_t g = 0; g < once.size(); ++g) {
    EXPECT_EQ(once[g].scores, again[g].scores);
    if (once[g].attacker.rfind("knows", 0) != 0) continue;
    for (const double p : once[g].scores) EXPECT_TRUE(p >= 0 && p <= 1);
  }
}

TEST(RealOrFake, TooFewPointsAreRefused) {
  KnownCloud cloud = makeUpCloud(true, 9);
  cloud.published.directions.resize(48);
  cloud.published.descriptors.resize(48);
  EXPECT_THROW(guessRealOrFake(cloud.published, kNetworks), std::runtime_error);
}

RealOrFakeClassifier classifierOf(const std::string &text) {
  const test::TempFolder folder;
  return RealOrFakeClassifier(folder.write("model.json", text));
}

nlohmann::json shipped() {
  return readModel(std::string(kNetworks) + "/real_or_fake_gaussian.json", "spherecloud real-or-fake 1");
}

TEST(RealOrFakeModel, ACopyOfTheShippedOneSaysTheSame) {
  const KnownCloud cloud = makeUpCloud(true, 8);
  const MapNeighbours neighbours = neighboursIn(cloud.published);
  const RealOrFakeFeatures features =
      realOrFakeFeatures(cloud.published, neighbours, CoOccurrence(std::string(kNetworks) + "/co_occurrence.json"));
  const Eigen::ArrayXf copied = classifierOf(shipped().dump()).probabilities(features, neighbours.beside);
  EXPECT_GT(copied.maxCoeff() - copied.minCoeff(), 0.02f);  // it does tell points from each other
  for (const RealOrFakeGuess &guess : guessRealOrFake(cloud.published, kNetworks)) {
    if (guess.attacker != "knows gaussian") continue;
    ASSERT_EQ(guess.scores.size(), static_cast<size_t>(copied.size()));
    for (Eigen::Index i = 0; i < copied.size(); ++i) EXPECT_EQ(guess.scores[static_cast<size_t>(i)], copied[i]);
    return;
  }
  FAIL() << "no attacker knows gaussian";
}

TEST(RealOrFakeModel, OthersAreRefused) {
  EXPECT_THROW(RealOrFakeClassifier(std::string("/nowhere/model.json")), std::runtime_error);
  EXPECT_THROW(classifierOf("{"), std::runtime_error);
  EXPECT_THROW(classifierOf("[1]"), std::runtime_error);
  EXPECT_THROW(RealOrFakeClassifier(std::string(kNetworks) + "/co_occurrence.json"), std::runtime_error);
  const auto spoilt = [](const char *pointer, const nlohmann::json &value) {
    nlohmann::json json = shipped();
    json[nlohmann::json::json_pointer(pointer)] = value;
    return classifierOf(json.dump());
  };
  EXPECT_THROW(spoilt("/first", 1), std::runtime_error);
  EXPECT_THROW(spoilt("/first/mean", {1, 2}), std::runtime_error);
  EXPECT_THROW(spoilt("/first/mean/0", "a"), std::runtime_error);
  EXPECT_THROW(spoilt("/first/mean/0", 1e300), std::runtime_error);
  EXPECT_THROW(spoilt("/second/layers", nlohmann::json::array()), std::runtime_error);
  EXPECT_THROW(spoilt("/second/layers/1/weights/3", {1}), std::runtime_error);
  EXPECT_THROW(spoilt("/second/layers/2", nullptr), std::runtime_error);
}

TEST(Mlp, ComputesByHand) {
  const auto json = nlohmann::json::parse(R"({"mean":[1,0],"scale":[2,1],"layers":[
      {"weights":[[1,0],[0,-1]],"bias":[0,0.5]},{"weights":[[3,10]],"bias":[-1]}]})");
  Eigen::MatrixXf rows(3, 2);
  rows << 2, 0, 1, 2, 100, 0;
  const Eigen::ArrayXf out = Mlp(json, 2)(rows);
  EXPECT_FLOAT_EQ(out[0], 3 * 2 + 10 * 0.5f - 1);
  EXPECT_FLOAT_EQ(out[1], -1);                     // both rectified
  EXPECT_FLOAT_EQ(out[2], 3 * 5 + 10 * 0.5f - 1);  // clipped at 5 deviations
}

TEST(CoOccurrence, IsTheSameWhicheverComesFirst) {
  const CoOccurrence network(std::string(kNetworks) + "/co_occurrence.json");
  Random random(10);
  const Eigen::MatrixXf a = network.components({test::randomDescriptor(&random)}),
                        b = network.components({test::randomDescriptor(&random)});
  EXPECT_FLOAT_EQ(network.logits(a, b)[0], network.logits(b, a)[0]);
}

}  // namespace
}  // namespace sphc::host
