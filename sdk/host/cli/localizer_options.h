// How localize and live are told of the localizer.
#pragma once
#include <CLI/CLI.hpp>

#include "host/cli/common/console.h"
#include "host/evaluate/parameters.h"

namespace sphc::host {

struct LocalizerOptions {
  sphc_localizer_config config = spherecloud::defaultConfig();  // without cameras
  Parameters parameters;
  uint32_t deadline_us = 0;  // of a frame; 0: none
};

constexpr char kAllTooLate[] = "Not one frame was localized before its deadline. Raise --deadline-us.";

void addLocalizerOptions(CLI::App *app, LocalizerOptions *options);

// A note where --row-time-ns straightens nothing.  `step_s`: from a frame to the next; NaN where nobody knows.
void noteRowsThatStay(const LocalizerOptions &options, double step_s, const Console &console);

}  // namespace sphc::host
