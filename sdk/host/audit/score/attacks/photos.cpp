#include "host/audit/attack/photos.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "host/audit/attack/co_occurrence.h"
#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/auc.h"
#include "host/audit/score/audit_context.h"
#include "host/audit/score/release_scores.h"
#include "host/base/counted.h"

namespace sphc::host {
namespace {

constexpr size_t kCompared = 16;   // marks of a stack that others are compared with
constexpr double kHomeRad = 0.02;  // as near a client puts what it recognises

double shareOf(size_t some, size_t all) { return all ? static_cast<double>(some) / static_cast<double>(all) : 0; }

// Of the real entries, those that share a layer with one that is marked.
size_t realBeside(const std::vector<uint32_t> &marked, const std::vector<EntryTruth> &truth,
                  const std::vector<uint32_t> &layers) {
  std::set<uint32_t> reached;
  for (const uint32_t entry : marked) reached.insert(layers[entry]);
  size_t real = 0;
  for (size_t i = 0; i < truth.size(); ++i) real += truth[i].real && reached.count(layers[i]);
  return real;
}

AttackResult runPhotos(AuditContext *context) {
  const PhotoMarks &marks = context->photoMarks();
  const Exposure plain = scoreEntries(marks.real, context->truth());
  const Exposure mirrored = scoreEntries(marks.fake, context->truth());
  const size_t mirrored_fake = mirrored.believed - mirrored.real;
  const size_t entries = context->truth().size();
  const auto real = static_cast<size_t>(std::count_if(context->truth().begin(), context->truth().end(),
                                                      [](const EntryTruth &entry) { return entry.real; }));
  return {{{"photos.share_of_real", shareOf(plain.real, real),
            counted(everyNth(context->photos(), kPhotos).size(), "photo") +
                (context->input().photos.empty() ? " of the mapping walk" : "")},
           {"photos.precision", plain.precision()},
           {"photos.share_of_fakes", shareOf(mirrored_fake, entries - real)},
           {"photos.precision_mirrored", shareOf(mirrored_fake, mirrored.believed)},
           {"photos.reach", shareOf(realBeside(marks.real, context->truth(), context->layers()), real)}}};
}

// How well an entry goes with some that are marked in its stack: the mean by the pairs' network.
double companyOf(const Eigen::MatrixXf &components, uint32_t entry, const std::vector<uint32_t> &all_marked,
                 const CoOccurrence &network) {
  if (all_marked.empty()) return 0;
  const std::vector<uint32_t> marked = everyNth(all_marked, kCompared);
  Eigen::MatrixXf own(static_cast<Eigen::Index>(marked.size()), components.cols()), others = own;
  for (size_t k = 0; k < marked.size(); ++k) {
    own.row(static_cast<Eigen::Index>(k)) = components.row(entry);
    others.row(static_cast<Eigen::Index>(k)) = components.row(marked[k]);
  }
  return static_cast<double>(network.logits(own, others).mean());
}

// Entries of stacks in which something is marked, and that are not: by how they go with what is marked real,
// against what is marked fake.
AttackResult runPhotoSpread(AuditContext *context) {
  const PhotoMarks &marks = context->photoMarks();
  const std::vector<uint32_t> &stacks = context->stacks();
  std::vector<PhotoMarks> of_stacks(1 + *std::max_element(stacks.begin(), stacks.end()));
  for (const uint32_t entry : marks.real) of_stacks[stacks[entry]].real.push_back(entry);
  for (const uint32_t entry : marks.fake) of_stacks[stacks[entry]].fake.push_back(entry);
  std::set<uint32_t> known(marks.real.begin(), marks.real.end());
  known.insert(marks.fake.begin(), marks.fake.end());
  const CoOccurrence network(context->input().networks + "/co_occurrence.json");
  const Eigen::MatrixXf components = network.components(context->map().descriptors);
  std::vector<double> scores;
  std::vector<bool> real;
  for (uint32_t i = 0; i < stacks.size(); ++i) {
    const PhotoMarks &here = of_stacks[stacks[i]];
    if ((here.real.empty() && here.fake.empty()) || known.count(i)) continue;
    scores.push_back(companyOf(components, i, here.real, network) - companyOf(components, i, here.fake, network));
    real.push_back(context->truth()[i].real);
  }
  if (std::set<bool>(real.begin(), real.end()).size() < 2)
    return {
        {{"photos.spread_auc", {}, "beside what photos mark there are no real and fake entries to be told apart"}}};
  const Auc auc = areaUnderCurve(scores, real);
  return {{{"photos.spread_auc", auc.value, std::to_string(scores.size()) + " entries", auc.standard_error}}};
}

// A client that knows its pose, and searches with its image turned over too: what it finds is fake, and it sees
// where that truly is.
AttackResult runTurnedClient(AuditContext *context) {
  std::set<uint32_t> learned, undone;
  const auto frames = context->ownPhotos(context->photos().size());
  for (const std::vector<OwnPoint> &frame : frames)
    for (const EntryPair &pair : matchesInCompany(context->map(), frame, Photo::kMirrored)) {
      const EntryTruth &truth = context->truth()[pair.b];
      if (truth.real) continue;
      learned.insert(pair.b);
      const Vector3 apart = truth.position_m.normalized() - frame[pair.a].position_m.normalized();
      if (apart.norm() < kHomeRad) undone.insert(pair.b);
    }
  const auto fakes = static_cast<size_t>(std::count_if(context->truth().begin(), context->truth().end(),
                                                       [](const EntryTruth &entry) { return !entry.real; }));
  return {{{"turned_client.share_of_fakes", shareOf(learned.size(), fakes),
            "after " + std::to_string(frames.size()) + " frames"},
           {"turned_client.undone", shareOf(undone.size(), fakes)}}};
}

}  // namespace

Attack photosAttack() {
  return {"photos",
          {Need::kTruth, Need::kRecording},
          {{"photos.share_of_real", "real entries that a few photos of the place mark", {}},
           {"photos.precision", "real among the entries that they mark", {}},
           {"photos.share_of_fakes", "fake entries that the same photos mark in the mirror", {}},
           {"photos.precision_mirrored", "fakes among the entries that they mark in the mirror", {}},
           {"photos.reach", "real entries in layers where one is marked: known, could layers be separated", {}}},
          runPhotos};
}

Attack photoSpreadAttack() {
  return {"photo_spread",
          {Need::kTruth, Need::kRecording, Need::kNetworks},
          {{"photos.spread_auc", "telling real from fake beside what photos mark; 0.5 is chance", {}}},
          runPhotoSpread};
}

Attack turnedClientAttack() {
  return {"turned_client",
          {Need::kTruth, Need::kRecording},
          {{"turned_client.share_of_fakes", "fakes that a client learns which turns its camera's image over", {}},
           {"turned_client.undone", "fakes whose true direction it learns", {}}},
          runTurnedClient};
}

}  // namespace sphc::host
