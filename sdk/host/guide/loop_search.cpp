#include "host/guide/loop_search.h"

#include <algorithm>

namespace sphc::host {
namespace {

constexpr LinkDemands kLoops = {25, 0.25};
constexpr uint32_t kApart = 12;  // places between the two views of a loop
constexpr int64_t kApartNs = 4000000000;
constexpr size_t kCandidates = 3;  // of a place
constexpr int kWitnesses = 6;      // pairs of views that are asked about a claim
// Two pairs of views agree: what a chain of a few links drifts.
constexpr double kAgreeM = 0.10, kAgreeRad = 0.05;

}  // namespace

void LoopSearch::forget() {
  claim_.reset();
  candidates_.clear();
  candidates_of_ = UINT32_MAX;
}

bool LoopSearch::mayBe(uint32_t place, const Located &here) const {
  const GuidePlace &then = places_[place], &now = places_[here.place];
  if (then.part != now.part) return true;
  return here.place > place + kApart && now.time_ns - then.time_ns > kApartNs;
}

std::optional<FoundLoop> LoopSearch::look(const Located &here) {
  if (claim_ && claim_->part != places_[here.place].part) claim_.reset();
  if (claim_) return askWitness(here);
  if (candidates_of_ != here.place) chooseCandidates(here);
  if (!candidates_.empty()) askCandidate(here);
  return std::nullopt;
}

void LoopSearch::chooseCandidates(const Located &here) {
  candidates_of_ = here.place;
  candidates_ = places_.likely(
      *here.frame, [&](uint32_t place) { return mayBe(place, here); }, kCandidates);
  std::reverse(candidates_.begin(), candidates_.end());
}

void LoopSearch::askCandidate(const Located &here) {
  const uint32_t place = candidates_.back();
  candidates_.pop_back();
  const auto found = places_.link(place, *here.frame, kLoops);
  if (found)
    claim_ = {place, here.place, places_[here.place].part, here.part_from_camera * found->link.b_from_a, 0};
}

// Places beside it, in turn; itself only once the camera has moved on.
std::optional<uint32_t> LoopSearch::nextWitness(const Located &here) {
  while (claim_->tries < kWitnesses) {
    const int turn = claim_->tries++ % 3;
    if (turn == 2 && here.place == claim_->seen_from) continue;
    if (turn == 1 && claim_->place == 0) continue;
    const uint32_t witness = turn == 0 ? claim_->place + 1 : turn == 1 ? claim_->place - 1 : claim_->place;
    if (witness >= places_.count() || places_[witness].part != places_[claim_->place].part) continue;
    if (mayBe(witness, here)) return witness;
  }
  return std::nullopt;
}

std::optional<FoundLoop> LoopSearch::askWitness(const Located &here) {
  const std::optional<uint32_t> witness = nextWitness(here);
  if (!witness) {
    claim_.reset();
    return std::nullopt;
  }
  const auto found = places_.link(*witness, *here.frame, kLoops);
  if (!found) return std::nullopt;
  const Rigid seen = here.part_from_camera * found->link.b_from_a;
  const Rigid claimed = claim_->part_from_place * places_[claim_->place].part_from_camera.inverse() *
                        places_[*witness].part_from_camera;
  const Rigid off = claimed.inverse() * seen;
  claim_.reset();
  if (off.translation_m.norm() > kAgreeM || rotationAngle(off.rotation) > kAgreeRad) return std::nullopt;
  return FoundLoop{*witness, found->link.inliers, found->link.b_from_a};
}

}  // namespace sphc::host
