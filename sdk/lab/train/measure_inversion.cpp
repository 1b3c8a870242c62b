// measure_inversion NETWORKS OUT PLACE...: how much inversion shows, with its controls.
// NETWORKS is the folder of the networks.  PLACE is name=recording,calibration,first,last,step.  OUT.csv has rows
// as tests/pipeline/privacy.csv; OUT.png shows views of the first place.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/audit/score/image_scores.h"
#include "host/audit/score/inversion_sheet.h"
#include "host/audit/score/known_cloud.h"
#include "host/audit/score/privacy_row.h"
#include "lab/train/measured_place.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

constexpr double kEta = 1.0 / 3;
constexpr char kNetwork[] = "mixed";

struct Metric {
  const char *name;
  double ImageScores::*score;
};
constexpr Metric kMetrics[] = {{"ncc", &ImageScores::ncc},
                               {"ssim", &ImageScores::ssim},
                               {"psnr_db", &ImageScores::psnr_db},
                               {"mae", &ImageScores::mae},
                               {"edge_recall", &ImageScores::edge_recall},
                               {"edge_chance", &ImageScores::edge_chance},
                               {"sift_found", &ImageScores::sift_found}};

void add(const ImageScores &scores, ImageScores *sum) {
  for (const Metric &metric : kMetrics) sum->*metric.score += scores.*metric.score;
}

// What an attacker is given.
struct Variant {
  std::string strategy;
  double eta;
  std::string name;
};

struct Tally {
  Variant variant;
  double views, fine_hits, coarse_hits;
  ImageScores sum;  // over views
};

double hitsOf(const Retrieval &retrieval) {
  return static_cast<double>(std::count(retrieval.hits.begin(), retrieval.hits.end(), true));
}

Tally tallyOf(const Variant &variant, const InversionResult &result, const std::vector<TruthView> &truths) {
  Tally tally = {variant, static_cast<double>(truths.size()), hitsOf(result.fine), hitsOf(result.coarse),
                 ImageScores()};
  for (size_t i = 0; i < truths.size(); ++i) add(scoreImage(result.pictures[i], truths[i]), &tally.sum);
  return tally;
}

class Measurement {
 public:
  explicit Measurement(const std::string &networks) : inverter_(networks, kNetwork) {}

  // Gives what was painted from the centre.
  std::vector<InversionResult> measure(const MeasuredPlace &place, SecretRandom *random) {
    place_ = &place;
    at_centre_.clear();
    attackFrames("own_keypoints", place.own_keypoints);
    attackFrames("unprotected", place.unprotected);
    std::vector<Vector3> directions;
    std::vector<Descriptor> descriptors;
    for (const SpherePoint &point : place.points) {
      directions.push_back(point.direction);
      descriptors.push_back(point.descriptor);
    }
    attackCentre({"none", 1, "centre"}, directions, descriptors, {});
    for (const auto &strategy : {gaussianFakes(), patchworkFakes()}) attackFakes(*strategy, random);
    shuffle(&descriptors, random);
    attackCentre({"shuffled", 1, "centre"}, directions, descriptors, {});
    return std::move(at_centre_);
  }

  // Of each place, and of all together.
  std::vector<PrivacyRow> rows() const {
    std::vector<PrivacyRow> rows = rows_;
    for (const Tally &total : totals_) addRows("all", total, &rows);
    return rows;
  }

 private:
  void attackFrames(const std::string &strategy, const std::vector<SeenPoints> &seen) {
    const std::vector<TruthView> &truths = place_->frame_truths;
    count(tallyOf({strategy, 1, "frame"}, invert(&inverter_, strategy, seen, truths), truths));
  }

  void attackCentre(const Variant &variant, const std::vector<Vector3> &directions,
                    const std::vector<Descriptor> &descriptors, const std::vector<float> &weights) {
    const std::string name = variant.strategy + " " + variant.name;
    at_centre_.push_back(invert(&inverter_, name, directions, descriptors, weights, place_->centre_views));
    count(tallyOf(variant, at_centre_.back(), truthsOf(place_->centre_views)));
  }

  void attackFakes(const FakeStrategy &strategy, SecretRandom *random) {
    const auto real = static_cast<size_t>(kEta * static_cast<double>(place_->points.size()));
    const KnownCloud cloud = knownCloud(strategy.assignments(place_->points, real, random));
    const std::vector<float> oracle(cloud.real.begin(), cloud.real.end());
    const Published &shown = cloud.published;
    attackCentre({strategy.name(), kEta, "centre"}, shown.directions, shown.descriptors, {});
    attackCentre({strategy.name(), kEta, "centre_oracle"}, shown.directions, shown.descriptors, oracle);
  }

  void count(const Tally &tally) {
    addRows(place_->name, tally, &rows_);
    const auto same = std::find_if(totals_.begin(), totals_.end(), [&tally](const Tally &other) {
      return other.variant.strategy == tally.variant.strategy && other.variant.name == tally.variant.name;
    });
    if (same == totals_.end()) return totals_.push_back(tally);
    same->views += tally.views;
    same->fine_hits += tally.fine_hits;
    same->coarse_hits += tally.coarse_hits;
    add(tally.sum, &same->sum);
  }

  static void addRows(const std::string &map, const Tally &tally, std::vector<PrivacyRow> *rows) {
    const Variant &variant = tally.variant;
    const auto row = [&](const std::string &metric, double value) {
      rows->push_back(
          {"inversion", map, variant.strategy, variant.eta, variant.name + "_" + kNetwork, metric, value});
    };
    const double n = std::max(1.0, tally.views);
    const auto share = [&](const std::string &metric, double hits) {
      row(metric, hits / n);
      row(metric + "_standard_error", std::sqrt(hits / n * (1 - hits / n) / n));
    };
    row("views", tally.views);
    share("retrieval_fine", tally.fine_hits);
    share("retrieval_coarse", tally.coarse_hits);
    for (const Metric &metric : kMetrics) row(metric.name, tally.sum.*metric.score / n);
  }

  Inverter inverter_;
  const MeasuredPlace *place_ = nullptr;
  std::vector<InversionResult> at_centre_;
  std::vector<PrivacyRow> rows_;
  std::vector<Tally> totals_;
};

void run(int argc, char **argv) {
  const std::string out = argv[2];
  Measurement measurement(argv[1]);
  for (int i = 3; i < argc; ++i) {
    SecretRandom random({1});  // the same figures every time; nothing here is published
    const MeasuredPlace place = readPlace(argv[i], &random);
    const std::vector<InversionResult> results = measurement.measure(place, &random);
    if (i == 3) cv::imwrite(out + ".png", inversionSheet(place.centre_views, results));
  }
  std::ofstream csv(out + ".csv");
  for (const PrivacyRow &row : measurement.rows()) csv << lineOf(row) << '\n';
  if (!csv.flush()) throw std::runtime_error(out + ".csv cannot be written; is the disk full?");
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("measure_inversion NETWORKS OUT NAME=RECORDING,CALIBRATION,FIRST,LAST,STEP...",
                             argc >= 4, [&] { sphc::host::run(argc, argv); });
}
