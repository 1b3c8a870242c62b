#include "lab/confidence/table.h"

#include "host/report/statistics.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

struct Calibration {
  size_t poses = 0;
  double correct = 0, confidence = 0;  // share, and mean
  double equal_width = 0, equal_count = 0;
  double brier = 0;  // mean squared difference of confidence and outcome
};

Calibration calibrationOf(const ConfidenceScene &scene, const ConfidenceModel &model) {
  const std::vector<Graded> graded = gradedRuns(scene, model);
  Calibration c;
  c.poses = graded.size();
  for (const Graded &g : graded) {
    const double outcome = g.correct ? 1 : 0, share = 1 / static_cast<double>(graded.size());
    c.correct += share * outcome;
    c.confidence += share * g.confidence;
    c.brier += share * (g.confidence - outcome) * (g.confidence - outcome);
  }
  c.equal_width = calibrationError(equalWidthBins(graded));
  c.equal_count = calibrationError(equalCountBins(graded));
  return c;
}

const char *roleOf(const ConfidenceScene &scene) { return scene.fitted_on ? "fitted on" : "shown on"; }

std::vector<std::string> cells(const ConfidenceScene &scene, const ConfidenceModel &model) {
  const Calibration c = calibrationOf(scene, model);
  return {scene.name,
          roleOf(scene),
          std::to_string(c.poses),
          fixed(100 * c.correct, 1),
          fixed(100 * c.confidence, 1),
          fixed(c.equal_width, 4),
          fixed(c.equal_count, 4),
          fixed(c.brier, 4)};
}

std::string joined(const std::vector<std::string> &cells) {
  std::string text;
  for (const std::string &cell : cells) text += (text.empty() ? "" : ",") + cell;
  return text + "\n";
}

}  // namespace

std::vector<Graded> gradedRuns(const ConfidenceScene &scene, const ConfidenceModel &model) {
  std::vector<Graded> graded;
  for (const ConfidenceRun &run : scene.runs) {
    ConfidenceFeatures features;
    const bool sound = confidenceFeatures(run.inputs, &features);
    graded.push_back({sound ? confidenceFrom(model, features) : 0, run.correct});
  }
  return graded;
}

std::string confidenceText(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model) {
  std::vector<std::vector<std::string>> rows = {
      {"scene", "", "poses", "right %", "confidence %", "ECE equal width", "ECE equal count", "Brier"}};
  for (const ConfidenceScene &scene : scenes) rows.push_back(cells(scene, model));
  return alignedText(rows);
}

std::string confidenceResults(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model) {
  std::string text = "scene,role,poses,right_percent,confidence_percent,ece_equal_width,ece_equal_count,brier\n";
  for (const ConfidenceScene &scene : scenes) text += joined(cells(scene, model));
  return text;
}

std::string confidenceCsv(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model) {
  std::string text =
      "scene,role,hardship,gain_share,inliers,gain_per_inlier,rotation_sigma_deg,centre_sigma_cm,confidence,"
      "rotation_error_deg,translation_error_cm,correct\n";
  for (const ConfidenceScene &scene : scenes) {
    const std::vector<Graded> graded = gradedRuns(scene, model);
    for (size_t i = 0; i < graded.size(); ++i) {
      const ConfidenceRun &run = scene.runs[i];
      const ConfidenceInputs &in = run.inputs;
      text += joined({scene.name, roleOf(scene), run.hardship, fixed(in.gain_share, 4), fixed(in.inliers, 0),
                      fixed(in.gain_per_inlier, 4), fixed(in.rotation_sigma_rad * 180 / kPi, 4),
                      fixed(100 * in.centre_sigma_m, 4), fixed(graded[i].confidence, 4),
                      fixed(run.rotation_error_deg, 4), fixed(100 * run.translation_error_m, 4),
                      run.correct ? "1" : "0"});
    }
  }
  return text;
}

nlohmann::ordered_json confidenceJson(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ConfidenceScene &scene : scenes) {
    const Calibration c = calibrationOf(scene, model);
    list.push_back({{"scene", scene.name},
                    {"fitted_on", scene.fitted_on},
                    {"poses", c.poses},
                    {"right_percent", 100 * c.correct},
                    {"confidence_percent", 100 * c.confidence},
                    {"ece_equal_width", c.equal_width},
                    {"ece_equal_count", c.equal_count},
                    {"brier", c.brier}});
  }
  return list;
}

Drawing drawConfidence(const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model) {
  std::vector<ReliabilitySeries> series;
  for (const ConfidenceScene &scene : scenes) {
    const std::vector<Graded> graded = gradedRuns(scene, model);
    series.push_back(
        {scene.name + ", " + roleOf(scene) + ", ECE " + fixed(calibrationError(equalWidthBins(graded)), 3),
         graded});
  }
  return {"confidence", "", "", reliabilityScript(series), {560, 660}};
}

}  // namespace sphc::host
