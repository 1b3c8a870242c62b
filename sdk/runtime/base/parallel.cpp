#include "runtime/base/parallel.h"

namespace sphc {

void Parallel::start(uint32_t count, Task task, void *data) const {
  if (count > 1)
    run(user, count, task, data);
  else if (count == 1)
    task(data, 0);
}

bool Parallel::startAll(uint32_t count, bool (*task)(void *, uint32_t), void *data) const {
  bool done[kMostPieces];
  forEach(count, [&](uint32_t index) { done[index] = task(data, index); });
  bool all = true;
  for (uint32_t i = 0; i < count; ++i) all = all && done[i];
  return all;
}

}  // namespace sphc
