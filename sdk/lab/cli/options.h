// Options that several benches have.
#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "host/frames/recording.h"
#include "lab/pose/bench.h"

namespace sphc::host {

// What is run on correspondences, and how often.
struct PoseRunOptions {
  std::vector<DepthSource> depths = {DepthSource::kTof};
  std::vector<std::string> only;
  uint32_t every = 1;
  BenchOptions bench;
};
// `what` is compared: "variant".
void addPoseRunOptions(CLI::App *app, PoseRunOptions *options, const std::string &what);

void addRepeatOption(CLI::App *app, uint32_t *repeats);
void addOnlyOption(CLI::App *app, std::vector<std::string> *only, const std::string &what);

// For what is compared with the recording's poses: throws std::runtime_error where no frame has one, and as
// openRecording does.
std::unique_ptr<RecordingReader> openRecordingWithPoses(const RecordingOptions &options);

// With no names everything is chosen.
bool isChosen(const std::vector<std::string> &only, const std::string &name);
// Throws UsageError, which tells the names there are, when one of `only` is not among them.
void checkChoice(const std::vector<std::string> &only, const std::vector<std::string> &names);

template <typename Variant>
std::vector<Variant> chosenByName(const std::vector<std::string> &only, std::vector<Variant> all) {
  std::vector<std::string> names;
  for (const Variant &variant : all) names.push_back(variant.name);
  checkChoice(only, names);
  const auto is_left_out = [&only](const Variant &variant) { return !isChosen(only, variant.name); };
  all.erase(std::remove_if(all.begin(), all.end(), is_left_out), all.end());
  return all;
}

}  // namespace sphc::host
