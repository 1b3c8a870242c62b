// What a map of these frames could do: frames held out in turn, localized against the map of the others.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "host/frames/recording.h"
#include "host/import/rgbd_import.h"
#include "host/report/coverage.h"
#include "host/report/run.h"

namespace sphc::host {

struct AdviceOptions {
  RgbdImportOptions import;
  uint32_t folds = 5;  // blocks of neighbouring frames, each held out once
  std::vector<double> etas = {0.25, 0.33, 0.5, 1};
  double judged_eta = 0.33;  // of the frames that would fail
};

struct Recall {
  double eta = 0;
  uint32_t good = 0, frames = 0;  // within 5 cm and 5 deg, of those with a pose
  double median_m = 0;            // of the localized ones
};

struct Failure {
  uint32_t sequence = 0;
  std::string why;
  std::array<double, 3> view;  // where the camera looked, world
};

struct Advice {
  std::vector<std::string> left_out;  // what became of frames that took no part
  size_t points = 0;
  Coverage coverage;
  std::vector<std::array<double, 3>> directions;  // of all points, from their centre
  std::vector<Recall> recalls;
  std::vector<Failure> failures;
};

// `mapped` is told at once how all of it was mapped, before frames are held out.
// Throws std::runtime_error with cause and cure.
Advice advise(RecordingReader *reader, const AdviceOptions &options,
              const std::function<void(const RgbdImportSummary &all)> &mapped,
              const std::function<void(uint32_t done, uint32_t total)> &progress);

}  // namespace sphc::host
