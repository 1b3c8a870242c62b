#include "runtime/stages/capture/pairer.h"

#include "runtime/stages/capture/middle.h"

namespace sphc {
namespace {

// Unsigned, since times may lie anywhere in their range.
uint64_t distanceNs(int64_t a_ns, int64_t b_ns) {
  const uint64_t between = static_cast<uint64_t>(a_ns) - static_cast<uint64_t>(b_ns);
  return a_ns > b_ns ? between : 0 - between;
}
uint64_t distanceNs(const sphc_capture &a, const sphc_capture &b) { return distanceNs(middleNs(a), middleNs(b)); }

// The next capture of a stream is expected no sooner than this share of the gap after the last one.
uint64_t soonest(uint64_t gap_ns) { return gap_ns - gap_ns / 4; }

bool isKnown(const sphc_capture &capture) {
  return (capture.stream == SPHC_STREAM_COLOR || capture.stream == SPHC_STREAM_DEPTH) &&
         capture.clock >= SPHC_CLOCK_SOURCE && capture.clock <= SPHC_CLOCK_BOOTTIME &&
         capture.time_point >= SPHC_TIME_MIDDLE && capture.time_point <= SPHC_TIME_ARRIVAL;
}

}  // namespace

// In captures of the device, lost ones too.  A source that started anew counts from 0.
uint32_t Pairer::Queue::stepsTo(const sphc_capture &capture) const {
  return begun && capture.sequence > last_sequence ? capture.sequence - last_sequence : 1;
}

void Pairer::Queue::add(const sphc_capture &capture) {
  const int64_t middle_ns = middleNs(capture);
  if (begun) gap_ns = distanceNs(middle_ns, last_middle_ns) / stepsTo(capture);
  begun = true;
  last_sequence = capture.sequence;
  last_ns = capture.time_ns;
  last_middle_ns = middle_ns;
  slots[count++] = capture;
}

sphc_capture Pairer::Queue::takeFront() {
  const sphc_capture front = slots[0];
  --count;
  for (uint32_t i = 0; i < count; ++i) slots[i] = slots[i + 1];
  return front;
}

sphc_status Pairer::push(const sphc_capture &capture) {
  if (!isKnown(capture)) return SPHC_E_ARGUMENT;
  Queue &queue = capture.stream == SPHC_STREAM_COLOR ? color_ : depth_;
  if (begun_ && capture.clock != clock_) return SPHC_E_ARGUMENT;
  if (queue.begun && capture.time_ns < queue.last_ns) return SPHC_E_ARGUMENT;
  if (queue.count == config_.slots) return SPHC_E_CAPACITY;
  begun_ = true;
  clock_ = capture.clock;
  (&queue == &color_ ? counts_.color_lost : counts_.depth_lost) += queue.stepsTo(capture) - 1;
  queue.add(capture);
  return SPHC_OK;
}

// Could a capture yet to come be nearer to this one of the other stream than the oldest at hand?
bool Pairer::Queue::nextMayBeNearer(const sphc_capture &other) const {
  const int64_t newest_ns = middleNs(slots[count - 1]), other_ns = middleNs(other);
  const uint64_t nearest_ns = distanceNs(slots[0], other);
  if (newest_ns >= other_ns || !nearest_ns) return false;
  return soonest(gap_ns) < distanceNs(newest_ns, other_ns) + nearest_ns;
}

bool Pairer::isWithinTolerance(const sphc_capture &color, const sphc_capture &depth) const {
  return distanceNs(color, depth) <= static_cast<uint64_t>(config_.tolerance_ns);
}

bool Pairer::canStillImprove() const {
  if (ended_ || color_.count == config_.slots || depth_.count == config_.slots) return false;
  const sphc_capture &color = color_.slots[0], &depth = depth_.slots[0];
  if (depth_.nextMayBeNearer(color)) return true;
  // What is no pair is not held back, and the first pair is not, before colour has a rate.
  return color_.gap_ns > 0 && isWithinTolerance(color, depth) && color_.nextMayBeNearer(depth);
}

// Does the next colour capture fit the oldest depth better, and no other depth fits that one better?
bool Pairer::isColorOvertaken() const {
  if (color_.count < 2) return false;
  const sphc_capture &next = color_.slots[1], &depth = depth_.slots[0];
  if (distanceNs(next, depth) >= distanceNs(color_.slots[0], depth)) return false;
  return depth_.count < 2 || distanceNs(next, depth) < distanceNs(next, depth_.slots[1]);
}

sphc_status Pairer::drop(Queue *queue, sphc_pairer_drop why, sphc_capture *dropped) {
  *dropped = queue->takeFront();
  counts_.last_drop = why;
  if (why == SPHC_DROP_TOO_FAR) ++counts_.too_far;
  if (why == SPHC_DROP_OVERTAKEN) ++counts_.overtaken;
  if (why == SPHC_DROP_FULL) ++counts_.full;
  if (why == SPHC_DROP_ENDED) ++counts_.ended;
  return SPHC_AGAIN;
}

sphc_status Pairer::pop(sphc_capture *color_capture, sphc_capture *depth_capture, sphc_capture *dropped) {
  dropped->stream = SPHC_STREAM_NONE;
  if (!color_.count || !depth_.count) {
    Queue &rest = color_.count ? color_ : depth_;
    if (rest.count == 0 || (!ended_ && rest.count < config_.slots)) return SPHC_AGAIN;
    return drop(&rest, ended_ ? SPHC_DROP_ENDED : SPHC_DROP_FULL, dropped);
  }
  const sphc_capture &color = color_.slots[0];
  // A depth capture older than a better one finds no partner: every later colour capture is further away still.
  if (depth_.count > 1 && distanceNs(depth_.slots[1], color) <= distanceNs(depth_.slots[0], color))
    return drop(&depth_, SPHC_DROP_OVERTAKEN, dropped);
  if (isColorOvertaken()) return drop(&color_, SPHC_DROP_OVERTAKEN, dropped);
  if (canStillImprove()) return SPHC_AGAIN;
  if (isWithinTolerance(color, depth_.slots[0])) {
    *color_capture = color_.takeFront();
    *depth_capture = depth_.takeFront();
    ++counts_.pairs;
    return SPHC_OK;
  }
  return drop(middleNs(color) < middleNs(depth_.slots[0]) ? &color_ : &depth_, SPHC_DROP_TOO_FAR, dropped);
}

}  // namespace sphc
