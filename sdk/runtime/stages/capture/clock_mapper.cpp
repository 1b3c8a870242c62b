#include "runtime/stages/capture/clock_mapper.h"

#include <algorithm>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kReach_s = 3600;  // how far from the samples a time is mapped
constexpr double kSteady_s = 2;    // samples that span less tell no drift
constexpr uint32_t kLateInARow = 10;
constexpr double kMost_s = 9e9;  // of a time in nanoseconds

// Times may lie anywhere in their range.
int64_t difference(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) - static_cast<uint64_t>(b));
}
int64_t sum(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b));
}
double seconds(int64_t ns) { return 1e-9 * static_cast<double>(ns); }
int64_t nanoseconds(double s) {
  const double ns = 1e9 * std::min(std::max(s, -kMost_s), kMost_s);
  return static_cast<int64_t>(ns < 0 ? ns - 0.5 : ns + 0.5);
}

}  // namespace

void ClockMapper::start(int64_t source_ns, int64_t arrival_ns) {
  first_source_ns_ = source_ns;
  first_arrival_ns_ = arrival_ns;
  samples_ = count_ = late_in_a_row_ = 0;
  keep({0, 0});
}

sphc_status ClockMapper::add(int64_t source_ns, int64_t arrival_ns) {
  const bool first = samples_ == 0;
  const double source_s = seconds(difference(source_ns, first_source_ns_));
  const Sample sample = {source_s, seconds(difference(arrival_ns, first_arrival_ns_)) - source_s};
  const Fit fits = first ? Fit::kJump : judge(source_ns, sample);
  if (fits == Fit::kJump) start(source_ns, arrival_ns);
  if (fits == Fit::kGood) keep(sample);
  last_source_ns_ = source_ns;
  if (samples_ != UINT32_MAX) ++samples_;
  fitLine();
  if (first || fits != Fit::kJump) return SPHC_OK;
  ++restarts_;
  return SPHC_AGAIN;
}

// Samples that arrive early, or late again and again, say that a clock jumped.
ClockMapper::Fit ClockMapper::judge(int64_t source_ns, const Sample &sample) {
  const double step_s = seconds(difference(source_ns, last_source_ns_)), jump_s = seconds(config_.jump_ns);
  const double off_s = sample.late_s - lateAt(sample.source_s);
  late_in_a_row_ = off_s > jump_s ? late_in_a_row_ + 1 : 0;
  if (step_s <= 0 || step_s > kReach_s || off_s < -jump_s || late_in_a_row_ > kLateInARow) return Fit::kJump;
  return off_s > jump_s ? Fit::kLate : Fit::kGood;
}

void ClockMapper::keep(const Sample &sample) {
  if (count_ > 0 && sample.source_s < slot_ends_s_) {
    if (sample.late_s < slots_[count_ - 1].late_s) slots_[count_ - 1] = sample;
    return;
  }
  const double oldest_s = sample.source_s - seconds(config_.window_ns);
  uint32_t forgotten = 0;
  while (forgotten < count_ && slots_[forgotten].source_s < oldest_s) ++forgotten;
  std::copy(slots_ + forgotten, slots_ + count_, slots_);
  count_ -= forgotten;
  if (count_ == kSlots) std::copy(slots_ + 1, slots_ + count_--, slots_);
  slots_[count_++] = sample;
  slot_ends_s_ = sample.source_s + seconds(config_.window_ns) / kSlots;
}

void ClockMapper::fitLine() {
  Sample hull[kSlots];  // the lower one
  uint32_t n = 0;
  double middle_s = 0;
  for (const Sample *s = slots_; s != slots_ + count_; ++s) {
    middle_s += s->source_s / count_;
    while (n >= 2 && (hull[n - 1].late_s - hull[n - 2].late_s) * (s->source_s - hull[n - 2].source_s) >=
                         (s->late_s - hull[n - 2].late_s) * (hull[n - 1].source_s - hull[n - 2].source_s))
      --n;
    hull[n++] = *s;
  }
  uint32_t edge = 0;
  while (edge + 2 < n && hull[edge + 1].source_s < middle_s) ++edge;
  at_s_ = hull[edge].source_s;
  level_s_ = hull[edge].late_s;
  slope_ = 0;
  const double most = 1e-6 * config_.max_drift_ppm;
  if (n >= 2 && hull[n - 1].source_s - hull[0].source_s >= kSteady_s)
    slope_ =
        std::min(std::max((hull[edge + 1].late_s - level_s_) / (hull[edge + 1].source_s - at_s_), -most), most);
  double lowest_s = 0, squares = 0;  // a line of another slope than the edge's may cut through samples
  for (uint32_t i = 0; i < count_; ++i)
    lowest_s = std::min(lowest_s, slots_[i].late_s - lateAt(slots_[i].source_s));
  level_s_ += lowest_s;
  for (uint32_t i = 0; i < count_; ++i) {
    const double off_s = slots_[i].late_s - lateAt(slots_[i].source_s);
    squares += off_s * off_s;
  }
  scatter_s_ = sqrtOf(squares / count_);
}

sphc_status ClockMapper::map(int64_t source_ns, int64_t *host_ns) const {
  if (samples_ == 0) return SPHC_AGAIN;
  if (absOf(seconds(difference(source_ns, last_source_ns_))) > kReach_s) return SPHC_E_ARGUMENT;
  const int64_t since_ns = difference(source_ns, first_source_ns_);
  *host_ns = sum(first_arrival_ns_, since_ns + nanoseconds(lateAt(seconds(since_ns))) - config_.delay_ns);
  return SPHC_OK;
}

sphc_status ClockMapper::get(sphc_clock_mapping *mapping) const {
  int64_t host_ns = 0;
  const sphc_status status = map(last_source_ns_, &host_ns);
  if (status != SPHC_OK) return status;
  const double delay_sigma_s = seconds(config_.delay_sigma_ns);
  mapping->samples = samples_;
  mapping->restarts = restarts_;
  mapping->reserved = 0;
  mapping->offset_ns = difference(host_ns, last_source_ns_);
  mapping->drift_ppm = 1e6 * slope_;
  mapping->sigma_ns = nanoseconds(sqrtOf(scatter_s_ * scatter_s_ + delay_sigma_s * delay_sigma_s));
  return SPHC_OK;
}

}  // namespace sphc
