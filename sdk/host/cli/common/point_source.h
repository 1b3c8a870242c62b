// Where a map's points come from: a recording, a COLMAP model, or a point model that was saved.
#pragma once
#include <array>
#include <nlohmann/json.hpp>

#include "host/cli/common/console.h"
#include "host/cli/common/recording_options.h"
#include "host/import/colmap_import.h"
#include "host/import/rgbd_import.h"
#include "host/live/interrupt.h"

namespace sphc::host {

struct PointSource {
  RecordingOptions recording;
  RgbdImportOptions import;
  ColmapImportOptions colmap;
  std::string gravity = "level";
  std::string model;  // a saved one
};
void addPointSourceOptions(CLI::App *app, PointSource *source);
// Those of a recording alone: how its frames become points.
void addMappingOptions(CLI::App *app, RgbdImportOptions *import);
// Which depths count, metres.  Returns the options.
std::array<CLI::Option *, 2> addDepthRangeOptions(CLI::App *app, double *depth_min_m, double *depth_max_m);

struct ImportedPoints {
  PointModel model;
  std::string told;                         // how it went, one line
  std::vector<std::string> warnings;        // frames that took no part, faults
  std::vector<std::string> contradictions;  // why no map of this can be right; contradictions.h
  std::vector<std::string> doubts;          // why it may be wrong all the same; contradictions.h
  nlohmann::ordered_json facts;             // for --json
};
// Throw UsageError for options that make no sense together.
void checkDepthRange(double depth_min_m, double depth_max_m);
void checkMappingOptions(const RgbdImportOptions &import);
void checkPointSource(const PointSource &source);
// Of a source that passed the check.  Throws std::runtime_error with cause and cure, and where a signal came.
ImportedPoints importPoints(const PointSource &source, const Interrupt &interrupt, const Console &console);
// Throws UsageError where so many frames cannot agree on a point as are to.
void checkObservations(const RgbdImportOptions &import, uint64_t frames, const char *which = "");
// Of recordings that are open, the oldest first; `selection` says which of their frames (describeSelection()).
// `interrupt`: ends it too; may be null.
ImportedPoints importRecordings(const std::vector<RgbdSource> &recordings, const RgbdImportOptions &options,
                                const std::string &selection, const Interrupt *interrupt = nullptr);

}  // namespace sphc::host
