// What attacks share: each artefact is computed when an attack first asks for it, and once.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "host/audit/attack/querying_client.h"
#include "host/audit/score/audit_input.h"
#include "host/audit/score/known_cloud.h"
#include "host/audit/score/real_or_fake_scores.h"
#include "host/audit/score/truth.h"

namespace sphc::host {

// How well real points were told from fake ones, and by what.
struct RealOrFakeStudy {
  std::vector<RealOrFakeScores> scores;  // one an attacker, then the strongest again
  std::vector<double> strongest;         // its scores, a point each
};

// The paper's fakes of the same points, and the same attackers on them.
struct PaperControl {
  KnownCloud cloud;
  RealOrFakeStudy study;
};

// Entries that kPhotos photos of the place mark, as it is and in the mirror: real and fake, as their owner
// believes.
constexpr size_t kPhotos = 5;
struct PhotoMarks {
  std::vector<uint32_t> real, fake;
};

class AuditContext {
 public:
  // Throws std::runtime_error when the file is no map, or is not of the input's place.  `input` must outlive this.
  // `progress` hears what share of its work the attack that runs has done.
  AuditContext(const AuditInput &input, std::function<void(double share)> progress);

  const AuditInput &input() const { return input_; }
  const Published &map() const { return map_; }
  void tellDone(double share) const { progress_(share); }
  // Other releases of the place, or of its points, that the ledger lists and the input does not have.
  size_t releasesNotGiven() const { return releases_not_given_; }

  // Of attacks that need the truth alone.
  const std::vector<EntryTruth> &truth() const { return truth_; }
  double eta() const { return eta_; }     // share of real entries
  const Published &unprotected();         // all points in their true directions
  const std::vector<uint32_t> &stacks();  // as an attacker finds them
  const std::vector<uint32_t> &layers();  // of the stacks; layersOf
  // The input's, without the very keypoints that the map was made of.
  const std::vector<std::vector<ModelPoint>> &photos();
  // The same, from the centre.
  std::vector<std::vector<OwnPoint>> ownPhotos(size_t count);
  const PhotoMarks &photoMarks();

  // Of attacks that need truth and networks.
  const RealOrFakeStudy &realOrFake();
  const PaperControl &paper();

 private:
  const AuditInput &input_;
  std::function<void(double share)> progress_;
  Published map_;
  size_t releases_not_given_ = 0;
  std::vector<EntryTruth> truth_;
  std::vector<bool> real_;
  double eta_ = 0;
  std::optional<Published> unprotected_;
  std::optional<std::vector<uint32_t>> stacks_, layers_;
  std::optional<std::vector<std::vector<ModelPoint>>> photos_;
  std::optional<PhotoMarks> photo_marks_;
  std::optional<RealOrFakeStudy> real_or_fake_;
  std::optional<PaperControl> paper_;
};

}  // namespace sphc::host
