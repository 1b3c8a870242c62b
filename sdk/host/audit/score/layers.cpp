#include "host/audit/score/layers.h"

#include <algorithm>

#include "host/audit/attack/stacks.h"

namespace sphc::host {

std::vector<uint32_t> layersOf(const std::vector<EntryTruth> &truth, const std::vector<uint32_t> &stacks) {
  std::vector<std::vector<size_t>> fakes(1 + *std::max_element(stacks.begin(), stacks.end()));
  std::vector<uint32_t> layers = stacks;  // of real entries
  for (size_t i = 0; i < truth.size(); ++i)
    if (!truth[i].real) fakes[stacks[i]].push_back(i);
  auto next = static_cast<uint32_t>(fakes.size());
  for (const std::vector<size_t> &stack : fakes) {
    if (stack.empty()) continue;
    std::vector<Vector3> homes;
    for (const size_t i : stack) homes.push_back(truth[i].position_m.normalized());
    const std::vector<uint32_t> patches = stacksOf(homes);
    for (size_t k = 0; k < stack.size(); ++k) layers[stack[k]] = next + patches[k];
    next += 1 + *std::max_element(patches.begin(), patches.end());
  }
  return layers;
}

std::vector<double> layerMeans(const std::vector<double> &scores, const std::vector<uint32_t> &layers) {
  std::vector<double> sums(1 + *std::max_element(layers.begin(), layers.end())), counts(sums.size());
  for (size_t i = 0; i < scores.size(); ++i) {
    sums[layers[i]] += scores[i];
    ++counts[layers[i]];
  }
  std::vector<double> means;
  for (const uint32_t layer : layers) means.push_back(sums[layer] / counts[layer]);
  return means;
}

}  // namespace sphc::host
