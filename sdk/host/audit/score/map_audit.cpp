#include "host/audit/score/map_audit.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "host/audit/attack/density.h"
#include "host/audit/attack/intersection.h"
#include "host/audit/attack/leaks.h"
#include "host/audit/attack/querying_client.h"
#include "host/audit/attack/real_or_fake.h"
#include "host/audit/attack/triangulation.h"
#include "host/audit/score/known_cloud.h"
#include "host/audit/score/point_errors.h"
#include "host/audit/score/real_or_fake_scores.h"
#include "host/audit/score/release_scores.h"
#include "host/publish/fakes/strategy.h"
#include "host/publish/secret_random.h"

namespace sphc::host {
namespace {

constexpr double kAtCentre =
    1e-3;  // of directions' unit length: no line of a sphere cloud passes another elsewhere
constexpr size_t kQuickLines = 2000, kQuickViews = 24;
constexpr int kTriangulationSamples = 20000, kQuickTriangulationSamples = 3000;
const char *const kNetworks[] = {"mixed", "patchwork"};

template <typename T>
std::vector<T> everyNth(const std::vector<T> &all, size_t wanted) {
  const size_t step = std::max<size_t>(1, (all.size() + wanted - 1) / wanted);
  std::vector<T> some;
  for (size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

class Auditor {
 public:
  Auditor(const MapAuditInput &input, const std::map<std::string, double> &limits, const AuditProgress &progress)
      : input_(input), limits_(limits), progress_(progress), map_(publishedIn(input.file)) {
    if (!input.place) return;
    truth_ = truthOf(map_, *input.place);
    for (const EntryTruth &entry : truth_) real_.push_back(entry.real);
    eta_ = static_cast<double>(std::count(real_.begin(), real_.end(), true)) / static_cast<double>(real_.size());
  }

  MapAudit run() {
    attackFile();
    attackDensity();
    attackAssignments();
    attackPictures();
    for (size_t k = 0; k < input_.releases.size(); ++k) attackReleases(k);
    askAsClient();
    const auto defaults = defaultAuditLimits();
    for (const auto &[name, value] : limits_)
      if (!names_.count(name) && !defaults.count(name))
        throw std::runtime_error("no figure is named " + name + "; audit prints their names");
    return std::move(audit_);
  }

 private:
  AuditFigure &add(const std::string &name, const std::string &about, std::optional<double> value,
                   const std::string &remark = "") {
    AuditFigure figure = {name, about, value, 0, {}, true, remark};
    names_.insert(name);
    if (const auto limit = limits_.find(name); limit != limits_.end()) figure.limit = limit->second;
    audit_.figures.push_back(figure);
    return audit_.figures.back();
  }
  bool known(const std::string &name, const std::string &about) {
    if (input_.place) return true;
    add(name, about, {}, "wants --truth");
    return false;
  }

  void attackFile() {
    progress_("the file");
    add("file.stray_bytes", "bytes that no field accounts for", static_cast<double>(strayBytes(input_.file)));
    add("file.order_sigma", "order of entries, against chance", std::abs(orderZ(map_)));
    const char *name = "file.cues_sigma", *about = "real or fake by rank, low bits and equals, against chance";
    if (!known(name, about)) return;
    double worst = 0;
    for (const Cue &cue : fileCues(map_)) {
      const Auc auc = scoreCue(cue, truth_);
      worst = std::max(worst, std::abs(auc.value - 0.5) / auc.standard_error);
    }
    add(name, about, worst);
  }

  void attackDensity() {
    progress_("density of lines");
    std::vector<Line> lines;
    for (const Vector3 &direction : map_.directions) lines.push_back(Line::through(Vector3::Zero(), direction));
    if (input_.quick) lines = everyNth(lines, kQuickLines);
    const std::vector<Vector3> found = attackByDensity(lines, {}, [](uint64_t, uint64_t) {});
    add("density.at_centre", "share of lines whose points the density attack puts in the centre",
        shareWithin(found, Vector3::Zero(), kAtCentre))
        .at_most = false;
  }

  // Leaves the strongest scores for those who prune.
  void attackAssignments() {
    progress_("real or fake");
    const char *name = "real_or_fake.auc", *about = "telling real from fake entries; 0.5 is chance";
    if (!known(name, about)) return;
    const std::vector<RealOrFakeGuess> guesses = guessRealOrFake(map_, input_.networks);
    const std::vector<RealOrFakeScores> scores = scoreRealOrFake(guesses, real_);
    add(name, about, scores.back().auc);
    add("real_or_fake.precision_at_eta", "real among as many as there are, by the strongest",
        scores.back().precision_at_eta, "eta is " + std::to_string(eta_).substr(0, 5));
    const auto strongest = std::max_element(scores.begin(), scores.end() - 1,
                                            [](const auto &a, const auto &b) { return a.auc < b.auc; });
    scores_ = guesses[static_cast<size_t>(strongest - scores.begin())].scores;
  }

  void attackPictures() {
    progress_("pictures from the centre");
    const char *name = "inversion.of_papers",
               *about = "places told by inverted pictures, of those with the paper's fakes";
    if (!known(name, about)) return;
    std::vector<Inverter> inverters;
    for (const char *network : kNetworks) inverters.emplace_back(input_.networks, network);
    std::vector<Vector3> directions;
    std::vector<Descriptor> descriptors;
    for (const PlacePoint &point : input_.place->points) {
      directions.push_back((point.seen.position_m - input_.place->centre_m).normalized());
      descriptors.push_back(point.seen.descriptor);
    }
    audit_.views = input_.views.empty() ? pseudoTruth(&inverters.front(), directions, descriptors) : input_.views;
    if (input_.quick) audit_.views = everyNth(audit_.views, kQuickViews);
    const auto paint = [&](const std::string &what, const std::vector<Vector3> &where,
                           const std::vector<Descriptor> &look, const std::vector<float> &weights) {
      InversionResult best;  // of the networks, since an attacker takes the one that shows most
      for (Inverter &inverter : inverters) {
        InversionResult result = invert(&inverter, what, where, look, weights, audit_.views);
        if (best.pictures.empty() || result.coarse.top1 > best.coarse.top1) best = std::move(result);
      }
      audit_.inversions.push_back(std::move(best));
      return audit_.inversions.back().coarse.top1;
    };
    paint("no fakes", directions, descriptors, {});
    const double paper = paintPaper(directions, descriptors, paint);
    const double plain = paint("this map", map_.directions, map_.descriptors, {});
    const double own =
        std::max(plain, paint("this map, pruned", map_.directions, map_.descriptors, pruned(scores_, eta_)));
    SecretRandom random({1});  // of a control; hides nothing
    shuffle(&descriptors, &random);
    const double control = paint("descriptors shuffled", directions, descriptors, {});
    add(name, about, paper > 0 ? own / paper : 0,
        std::to_string(audit_.views.size()) + (input_.views.empty() ? " views, pseudo truth" : " views"));
    add("inversion.retrieval", "places told by inverted pictures, unpruned or pruned, whichever is more", own)
        .standard_error =
        std::sqrt(own * (1 - own) / std::max<double>(1, static_cast<double>(audit_.views.size())));
    add("inversion.retrieval_paper", "the same, had the paper's fakes been used", paper);
    add("inversion.retrieval_shuffled", "the same without any information", control);
  }

  // The paper's fakes of the same points, pruned by the same attacker.
  template <typename Paint>
  double paintPaper(const std::vector<Vector3> &directions, const std::vector<Descriptor> &descriptors,
                    const Paint &paint) {
    std::vector<SpherePoint> points;
    for (size_t i = 0; i < directions.size(); ++i) points.push_back({directions[i], descriptors[i]});
    SecretRandom random({1});
    shuffle(&points, &random);
    const auto real_count = static_cast<size_t>(eta_ * static_cast<double>(points.size()));
    const KnownCloud paper = knownCloud(gaussianFakes()->assignments(points, real_count, &random));
    const Published &shown = paper.published;
    const std::vector<RealOrFakeGuess> guesses = guessRealOrFake(shown, input_.networks);
    double best = 0;
    std::vector<double> scores;
    for (const RealOrFakeGuess &guess : guesses) {
      const double auc = areaUnderCurve(guess.scores, paper.real).value;
      if (auc <= best) continue;
      best = auc;
      scores = guess.scores;
    }
    add("real_or_fake.auc_paper", "the same, had the paper's fakes been used", best);
    const double plain = paint("paper's fakes", shown.directions, shown.descriptors, {});
    return std::max(plain,
                    paint("paper's fakes, pruned", shown.directions, shown.descriptors, pruned(scores, eta_)));
  }

  void attackReleases(size_t k) {
    const std::string which = "release " + std::to_string(k + 1);
    progress_(which);
    const Published other = publishedIn(input_.releases[k]);
    TriangulationOptions options;
    options.samples = input_.quick ? kQuickTriangulationSamples : kTriangulationSamples;
    add("triangulation.pose_found", "a pose between this map's centre and another's",
        triangulateReleases(map_, other, options).found, which);
    const std::vector<uint32_t> agree = intersectReleases({map_, other}, {}).front();
    const double share = static_cast<double>(agree.size()) / static_cast<double>(map_.directions.size());
    add("intersection.agreeing_share", "entries that another release confirms", share, which);
    const char *name = "intersection.gain", *about = "real among entries that another release confirms, above eta";
    if (!known(name, about)) return;
    add(name, about, agree.empty() ? 0 : scoreEntries(agree, truth_).precision() - eta_, which);
  }

  void askAsClient() {
    const char *name = "querying_client.share_of_real";
    const char *about = "real entries that a client with a depth camera learns";
    if (!known(name, about)) return;
    if (input_.queries.empty()) {
      add(name, about, {}, "wants --recording");
      return;
    }
    progress_("a client's queries");
    QueryingClient client(map_);
    for (const std::vector<ModelPoint> &frame : input_.queries) {
      std::vector<OwnPoint> own;
      for (const ModelPoint &point : frame)
        own.push_back({point.position_m - input_.place->centre_m, point.descriptor});
      client.query(own);
    }
    add(name, about, scoreLearned(client.learned(), truth_).share_of_real,
        "after " + std::to_string(input_.queries.size()) + " frames; no map can prevent it");
  }

  const MapAuditInput &input_;
  const std::map<std::string, double> &limits_;
  const AuditProgress &progress_;
  Published map_;
  std::vector<EntryTruth> truth_;
  std::vector<bool> real_;
  double eta_ = 0;
  std::vector<double> scores_;
  std::set<std::string> names_;
  MapAudit audit_;
};

}  // namespace

Verdict AuditFigure::verdict() const {
  if (!value) return Verdict::kNotMeasured;
  if (!limit) return Verdict::kInformation;
  return (at_most ? *value <= *limit : *value >= *limit) ? Verdict::kHolds : Verdict::kBroken;
}

bool MapAudit::holds() const {
  return std::none_of(figures.begin(), figures.end(),
                      [](const AuditFigure &figure) { return figure.verdict() == Verdict::kBroken; });
}

std::map<std::string, double> defaultAuditLimits() {
  return {{"file.stray_bytes", 0},         {"file.order_sigma", 4.5},  {"file.cues_sigma", 4.5},
          {"density.at_centre", 0.99},     {"real_or_fake.auc", 0.60}, {"inversion.of_papers", 0.5},
          {"triangulation.pose_found", 0}, {"intersection.gain", 0.03}};
}

MapAudit auditMap(const MapAuditInput &input, const std::map<std::string, double> &limits,
                  const AuditProgress &progress) {
  return Auditor(input, limits, progress).run();
}

}  // namespace sphc::host
