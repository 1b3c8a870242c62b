// measure_real_or_fake NETWORKS MAP STRATEGY CLOUD: rows of tests/pipeline/privacy.csv for a cloud whose truth is
// known; MAP and STRATEGY are what the rows shall call them.
#include <algorithm>
#include <cstdio>

#include "host/audit/score/real_or_fake_scores.h"
#include "lab/train/real_or_fake/cloud_file.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

void run(char **arguments) {
  const KnownCloud cloud = readCloud(arguments[4]);
  const double eta = static_cast<double>(std::count(cloud.real.begin(), cloud.real.end(), true)) /
                     static_cast<double>(cloud.real.size());
  const std::vector<RealOrFakeGuess> guesses = turnedGuesses(cloud.published, cloud.real, arguments[1]);
  const auto scores = scoreRealOrFake(guesses, cloud.real, cloud.patches);
  for (const PrivacyRow &row : realOrFakeRows(scores, arguments[2], arguments[3], eta))
    std::puts(lineOf(row).c_str());
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("measure_real_or_fake NETWORKS MAP STRATEGY CLOUD", argc == 5,
                             [&] { sphc::host::run(argv); });
}
