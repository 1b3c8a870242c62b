#include "runtime/stages/capture/pairer.h"

namespace sphc {
namespace {

// Unsigned, since times may lie anywhere in their range.
uint64_t distanceNs(const sphc_capture &a, const sphc_capture &b) {
  const uint64_t between = static_cast<uint64_t>(a.time_ns) - static_cast<uint64_t>(b.time_ns);
  return a.time_ns > b.time_ns ? between : 0 - between;
}

}  // namespace

sphc_capture Pairer::Queue::takeFront() {
  const sphc_capture front = slots[0];
  --count;
  for (uint32_t i = 0; i < count; ++i) slots[i] = slots[i + 1];
  return front;
}

sphc_status Pairer::push(const sphc_capture &capture) {
  if (capture.stream != SPHC_STREAM_COLOR && capture.stream != SPHC_STREAM_DEPTH) return SPHC_E_ARGUMENT;
  Queue &queue = capture.stream == SPHC_STREAM_COLOR ? color_ : depth_;
  if (queue.count == config_.slots) return SPHC_E_CAPACITY;
  if (queue.count && capture.time_ns < queue.slots[queue.count - 1].time_ns) return SPHC_E_ARGUMENT;
  queue.slots[queue.count++] = capture;
  return SPHC_OK;
}

// Could a depth capture yet to come fit the oldest colour capture better than those at hand?
bool Pairer::canStillImprove() const {
  if (ended_ || color_.count == config_.slots || depth_.count == config_.slots) return false;
  return depth_.slots[depth_.count - 1].time_ns < color_.slots[0].time_ns;
}

sphc_status Pairer::pop(sphc_pair *pair, sphc_capture *dropped) {
  dropped->stream = SPHC_STREAM_NONE;
  if (!color_.count || !depth_.count) {
    Queue &rest = color_.count ? color_ : depth_;
    if (rest.count && (ended_ || rest.count == config_.slots)) *dropped = rest.takeFront();
    return SPHC_AGAIN;
  }
  const sphc_capture &color = color_.slots[0];
  // Depth captures that are older than a better one are nobody's partner: every later colour is further away still.
  if (depth_.count > 1 && distanceNs(depth_.slots[1], color) <= distanceNs(depth_.slots[0], color)) {
    *dropped = depth_.takeFront();
    return SPHC_AGAIN;
  }
  if (canStillImprove()) return SPHC_AGAIN;
  if (distanceNs(color, depth_.slots[0]) <= static_cast<uint64_t>(config_.tolerance_ns)) {
    pair->color = color_.takeFront();
    pair->depth = depth_.takeFront();
    return SPHC_OK;
  }
  Queue &older = color.time_ns < depth_.slots[0].time_ns ? color_ : depth_;
  *dropped = older.takeFront();
  return SPHC_AGAIN;
}

}  // namespace sphc
