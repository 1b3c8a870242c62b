#include "host/publish/fakes/strategy.h"

#include <stdexcept>

namespace sphc::host {
namespace {

struct Maker {
  const char *name;
  std::unique_ptr<FakeStrategy> (*make)(const FakeOptions &);
};

const Maker kMakers[] = {
    {"gaussian", [](const FakeOptions &options) { return gaussianFakes(options.sigma2); }},
    {"patchwork", [](const FakeOptions &options) { return patchworkFakes(options.patch_deg); }},
    {"warped", [](const FakeOptions &options) { return warpedFakes(options.patch_deg); }}};

}  // namespace

std::vector<std::string> fakeNames() {
  std::vector<std::string> names;
  for (const Maker &maker : kMakers) names.emplace_back(maker.name);
  return names;
}

std::unique_ptr<FakeStrategy> makeFakes(const std::string &name, const FakeOptions &options) {
  std::string known;
  for (const Maker &maker : kMakers) {
    if (maker.name == name) return maker.make(options);
    known += std::string(known.empty() ? "" : ", ") + maker.name;
  }
  throw std::runtime_error("no fakes are made by '" + name + "'; choose from: " + known);
}

}  // namespace sphc::host
