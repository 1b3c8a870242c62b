#include "runtime/base/parallel.h"

namespace sphc {

namespace {

// Each piece once, though the caller's function skips some, runs some twice, or invents one.
struct Job {
  Parallel::Task task;
  void *data;
  uint32_t count;
  uint32_t begun;  // a bit for each piece; set by several threads

  static void once(void *self, uint32_t index) {
    auto &job = *static_cast<Job *>(self);
    if (index >= job.count) return;
    const uint32_t bit = 1u << index;
    if ((__atomic_fetch_or(&job.begun, bit, __ATOMIC_RELAXED) & bit) == 0) job.task(job.data, index);
  }
};

}  // namespace

void Parallel::start(uint32_t count, Task task, void *data) const {
  static_assert(kMostPieces <= 32);
  if (count == 1) return task(data, 0);
  Job job = {task, data, count, 0};
  if (count > 1) run(user, count, Job::once, &job);
  for (uint32_t i = 0; i < count; ++i) Job::once(&job, i);
}

bool Parallel::startAll(uint32_t count, bool (*task)(void *, uint32_t), void *data) const {
  bool done[kMostPieces];
  forEach(count, [&](uint32_t index) { done[index] = task(data, index); });
  bool all = true;
  for (uint32_t i = 0; i < count; ++i) all = all && done[i];
  return all;
}

}  // namespace sphc
