// measure_inversion NETWORKS OUT PLACE...: how much inversion shows, with its controls.
// NETWORKS is the folder of the networks.  PLACE is name=recording,calibration,first,last,step.  OUT.csv has rows
// attack,map,strategy,eta,variant,metric,value; OUT.png shows views of the first place.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/audit/attack/inversion.h"
#include "host/audit/score/image_scores.h"
#include "host/audit/score/known_cloud.h"
#include "host/audit/score/retrieval.h"
#include "host/audit/train/measured_place.h"
#include "host/audit/train/tool.h"

namespace sphc::host {
namespace {

constexpr double kEta = 1.0 / 3;
constexpr size_t kPictured = 6;  // views in the picture
const char *const kNetworks[] = {"mixed"};

// What an attacker is given at one place: points for each view, and the truths.
struct Variant {
  std::string strategy, eta, name;
};

struct Row {
  Variant variant;
  ImageScores sum;  // over views
  double fine_hits = 0, coarse_hits = 0, views = 0;
};

double hitsOf(const Retrieval &retrieval) {
  return static_cast<double>(std::count(retrieval.hits.begin(), retrieval.hits.end(), true));
}

void add(const ImageScores &scores, ImageScores *sum) {
  sum->psnr_db += scores.psnr_db;
  sum->ssim += scores.ssim;
  sum->mae += scores.mae;
  sum->ncc += scores.ncc;
  sum->edge_recall += scores.edge_recall;
  sum->edge_chance += scores.edge_chance;
  sum->sift_found += scores.sift_found;
}

class Measurement {
 public:
  Measurement(const std::string &networks, std::ostream *csv) : networks_(networks), csv_(csv) {}

  void measure(const MeasuredPlace &place, SecretRandom *random) {
    place_ = &place;
    picture_.release();
    attack({"own_keypoints", "1", "frame"}, place.own_keypoints, place.frame_truths);
    attack({"unprotected", "1", "frame"}, place.unprotected, place.frame_truths);
    show(place.centre_truths);
    std::vector<Vector3> directions;
    std::vector<Descriptor> descriptors;
    for (const SpherePoint &point : place.points) {
      directions.push_back(point.direction);
      descriptors.push_back(point.descriptor);
    }
    attackCentre({"none", "1", "centre"}, directions, descriptors, {});
    for (const auto &strategy : {gaussianFakes(), patchworkFakes()}) measureFakes(*strategy, random);
    shuffle(&descriptors, random);
    attackCentre({"shuffled", "1", "centre"}, directions, descriptors, {});
  }

  // All places together.
  void writeTotals() const {
    for (const Row &row : totals_) write("all", row);
  }
  const cv::Mat &picture() const { return picture_; }

 private:
  void measureFakes(const FakeStrategy &strategy, SecretRandom *random) {
    const auto real = static_cast<size_t>(kEta * static_cast<double>(place_->points.size()));
    const KnownCloud cloud = knownCloud(strategy.fates(place_->points, real, random));
    const std::vector<float> oracle(cloud.real.begin(), cloud.real.end());
    const Published &shown = cloud.published;
    attackCentre({strategy.name(), "0.33", "centre"}, shown.directions, shown.descriptors, {});
    attackCentre({strategy.name(), "0.33", "centre_oracle"}, shown.directions, shown.descriptors, oracle);
  }

  void attackCentre(const Variant &variant, const std::vector<Vector3> &directions,
                    const std::vector<Descriptor> &descriptors, const std::vector<float> &weights) {
    std::vector<SeenPoints> seen;
    for (const Matrix3 &rotation : place_->rotations)
      seen.push_back(see(directions, descriptors, weights, {rotation, Vector3::Zero()}));
    attack(variant, seen, place_->centre_truths);
  }

  void attack(const Variant &variant, const std::vector<SeenPoints> &seen, const std::vector<TruthView> &truths) {
    for (const char *network : kNetworks) {
      Inverter inverter(networks_, network);
      Row row = {{variant.strategy, variant.eta, variant.name + "_" + network}, {}, 0, 0, 0};
      std::vector<cv::Mat> pictures;
      for (size_t i = 0; i < seen.size(); ++i) {
        pictures.push_back(inverter.paint(seen[i]));
        add(scoreImage(pictures[i], truths[i]), &row.sum);
      }
      row.fine_hits = hitsOf(retrieve(pictures, truths, kFineCells));
      row.coarse_hits = hitsOf(retrieve(pictures, truths, kCoarseCells));
      row.views = static_cast<double>(seen.size());
      write(place_->name, row);
      total(row);
      if (variant.name != "frame") show(pictures);
    }
  }

  void total(const Row &row) {
    const auto same = std::find_if(totals_.begin(), totals_.end(), [&row](const Row &other) {
      return other.variant.strategy == row.variant.strategy && other.variant.name == row.variant.name;
    });
    if (same == totals_.end()) return totals_.push_back(row);
    add(row.sum, &same->sum);
    same->fine_hits += row.fine_hits;
    same->coarse_hits += row.coarse_hits;
    same->views += row.views;
  }

  void write(const std::string &map, const Row &row) const {
    const auto line = [&](const std::string &metric, double value) {
      *csv_ << "inversion," << map << ',' << row.variant.strategy << ',' << row.variant.eta << ','
            << row.variant.name << ',' << metric << ',' << value << '\n';
    };
    const double n = std::max(1.0, row.views);
    const auto share = [&](const std::string &metric, double hits) {
      line(metric, hits / n);
      line(metric + "_standard_error", std::sqrt(hits / n * (1 - hits / n) / n));
    };
    line("views", row.views);
    share("retrieval_fine", row.fine_hits);
    share("retrieval_coarse", row.coarse_hits);
    line("ncc", row.sum.ncc / n);
    line("ssim", row.sum.ssim / n);
    line("psnr_db", row.sum.psnr_db / n);
    line("mae", row.sum.mae / n);
    line("edge_recall", row.sum.edge_recall / n);
    line("edge_chance", row.sum.edge_chance / n);
    line("sift_found", row.sum.sift_found / n);
  }

  // A row of the picture.
  void show(const std::vector<TruthView> &truths) {
    std::vector<cv::Mat> pictures;
    for (const TruthView &truth : truths) pictures.push_back(truth.grey);
    show(pictures);
  }
  void show(const std::vector<cv::Mat> &pictures) {
    cv::Mat strip;
    for (size_t k = 0; k < kPictured && !pictures.empty(); ++k) {
      cv::Scalar mean, deviation;
      const cv::Mat &picture = pictures[k * (pictures.size() - 1) / (kPictured - 1)];
      cv::meanStdDev(picture, mean, deviation);
      const double gain = 55 / std::max(deviation[0], 1e-6);
      cv::Mat bytes;
      picture.convertTo(bytes, CV_8U, gain, 120 - gain * mean[0]);
      cv::copyMakeBorder(bytes, bytes, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar(255));
      if (strip.empty())
        strip = bytes;
      else
        cv::hconcat(strip, bytes, strip);
    }
    if (picture_.empty())
      picture_ = strip;
    else
      cv::vconcat(picture_, strip, picture_);
  }

  std::string networks_;
  std::ostream *csv_;
  const MeasuredPlace *place_ = nullptr;
  std::vector<Row> totals_;
  cv::Mat picture_;
};

void run(int argc, char **argv) {
  const std::string out = argv[2];
  std::ofstream csv(out + ".csv");
  Measurement measurement(argv[1], &csv);
  for (int i = 3; i < argc; ++i) {
    SecretRandom random({1});  // the same figures every time; nothing here is published
    measurement.measure(readPlace(argv[i], &random), &random);
    if (i == 3) cv::imwrite(out + ".png", measurement.picture());
  }
  measurement.writeTotals();
  if (!csv.flush()) throw std::runtime_error(out + ".csv cannot be written; is the disk full?");
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("measure_inversion NETWORKS OUT NAME=RECORDING,CALIBRATION,FIRST,LAST,STEP...",
                             argc >= 4, [&] { sphc::host::run(argc, argv); });
}
