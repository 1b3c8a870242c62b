#include "lab/features/table.h"

#include <cmath>

#include "host/report/run.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

std::string ratioText(double ratio, const char *missing) { return std::isnan(ratio) ? missing : fixed(ratio, 1); }

}  // namespace

std::string featuresText(const FeaturesTable &table) {
  std::vector<std::vector<std::string>> rows = {{"variant", "keypoints", "ms", "p99", "x opencv sift"}};
  for (const uint32_t gap : kFeatureGaps) {
    const std::string at = " at " + std::to_string(gap);
    for (const char *what : {"matches", "verified", "px"}) rows[0].push_back(what + at);
  }
  for (const FeaturesSummary &s : table.summaries) {
    rows.push_back({s.name, fixed(s.keypoints, 0), fixed(s.median_ms, 2), fixed(s.p99_ms, 2),
                    ratioText(s.times_faster_than_opencv, "-")});
    for (const PairQuality &q : s.gaps) {
      for (const std::string &text : {fixed(q.matches, 1), fixed(q.verified, 1), fixed(q.sampson_px, 2)})
        rows.back().push_back(text);
    }
  }
  return table.recording + ", " + std::to_string(table.frames) + " frames\n" + alignedText(rows);
}

std::string featuresResults(const std::vector<FeaturesTable> &tables) {
  std::string text = "recording,variant,keypoints,times_faster_than_opencv_sift";
  for (const uint32_t gap : kFeatureGaps) {
    const std::string at = "_gap" + std::to_string(gap);
    text += ",matches" + at + ",verified" + at + ",sampson_px" + at;
  }
  text += "\n";
  for (const FeaturesTable &table : tables) {
    for (const FeaturesSummary &s : table.summaries) {
      text += table.recording + "," + csvText(s.name) + "," + fixed(s.keypoints, 0) + "," +
              ratioText(s.times_faster_than_opencv, "");
      for (const PairQuality &q : s.gaps)
        text += "," + fixed(q.matches, 1) + "," + fixed(q.verified, 1) + "," + fixed(q.sampson_px, 3);
      text += "\n";
    }
  }
  return text;
}

nlohmann::ordered_json featuresJson(const std::vector<FeaturesTable> &tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FeaturesTable &table : tables) {
    nlohmann::ordered_json variants = nlohmann::ordered_json::array();
    for (const FeaturesSummary &s : table.summaries) {
      nlohmann::ordered_json gaps = nlohmann::ordered_json::array();
      for (size_t g = 0; g < kFeatureGaps.size(); ++g) {
        gaps.push_back({{"frames", kFeatureGaps[g]},
                        {"pairs", s.gaps[g].pairs},
                        {"matches_mean", s.gaps[g].matches},
                        {"verified_mean", s.gaps[g].verified},
                        {"sampson_px_median", s.gaps[g].sampson_px}});
      }
      variants.push_back({{"variant", s.name},
                          {"keypoints_mean", s.keypoints},
                          {"time_ms", {{"median", s.median_ms}, {"p99", s.p99_ms}}},
                          {"times_faster_than_opencv_sift", s.times_faster_than_opencv},
                          {"gaps", gaps}});
    }
    list.push_back({{"recording", table.recording}, {"frames", table.frames}, {"variants", variants}});
  }
  return list;
}

}  // namespace sphc::host
