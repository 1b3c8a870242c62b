#include "lab/common/interleave.h"

#include <time.h>

#include <numeric>
#include <utility>

#include "host/report/statistics.h"

namespace sphc::host {
std::vector<size_t> shuffledOrder(size_t count, Random *random) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random->below(static_cast<uint32_t>(i))]);
  return order;
}

std::vector<double> interleave(size_t count, uint32_t repeats, Random *random, const TimedRun &run) {
  std::vector<std::vector<double>> seconds(count);
  for (uint32_t repeat = 0; repeat < repeats; ++repeat) {
    for (const size_t chosen : shuffledOrder(count, random)) {
      if (repeat > 0 && seconds[chosen][0] > kSlowS) continue;
      seconds[chosen].push_back(run(chosen, repeat));
    }
  }
  std::vector<double> medians;
  for (const auto &of_variant : seconds) medians.push_back(percentile(of_variant, 0.5));
  return medians;
}

double threadCpuSeconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace sphc::host
