// How well the confidence holds, scene by scene: a table, csv, the results, the reliability diagram.
#pragma once
#include <nlohmann/json.hpp>

#include "host/report/reliability_plot.h"
#include "lab/confidence/run.h"

namespace sphc::host {

std::vector<Graded> gradedRuns(const ConfidenceScene &scene, const ConfidenceModel &model);

std::string confidenceText(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model);
// One line a pose: scene, features, confidence, errors.
std::string confidenceCsv(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model);
// One line a scene.
std::string confidenceResults(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model);
nlohmann::ordered_json confidenceJson(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model);
Drawing drawConfidence(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model);

}  // namespace sphc::host
