#include "drivers.h"
#include "drivers/simulated/simulated.h"

namespace sphc::contract {

namespace {

constexpr uint32_t kFrames = 6;

// Opening builds and paints a room.  A handle that a test is done with is stopped and kept for the next test.
class SimulatedPool {
 public:
  ~SimulatedPool() {
    for (sphc_simulated *simulated : idle_) sphc_simulated_close(&simulated);
  }

  sphc_simulated *take() {
    if (idle_.empty()) return open();
    sphc_simulated *simulated = idle_.back();
    idle_.pop_back();
    return simulated;
  }

  void giveBack(sphc_simulated *simulated) {
    const sphc_source source = sourceOf(simulated);
    source.stop(source.self);
    idle_.push_back(simulated);
  }

  static sphc_source sourceOf(sphc_simulated *simulated) {
    sphc_source source{};
    source.struct_size = sizeof source;
    sphc_simulated_source(simulated, &source);
    return source;
  }

 private:
  static sphc_simulated *open() {
    sphc_simulated_config config;
    sphc_simulated_config_init(&config, sizeof config);
    config.frame_count = kFrames;
    config.raw_depth = 1;    // with amplitudes
    config.motion_blur = 0;  // renders faster
    sphc_simulated *simulated = nullptr;
    sphc_simulated_open(&config, &simulated, nullptr);
    return simulated;
  }

  std::vector<sphc_simulated *> idle_;
};

OpenedDriver openSimulated() {
  static SimulatedPool pool;
  sphc_simulated *simulated = pool.take();
  if (!simulated) return {};
  return {SimulatedPool::sourceOf(simulated), {simulated, [](sphc_simulated *done) { pool.giveBack(done); }}};
}

}  // namespace

std::vector<Driver> driversUnderTest() {
  Driver simulated = {"Simulated", openSimulated, 2 * kFrames};
  simulated.gives_amplitudes = true;
  return {simulated};
}

}  // namespace sphc::contract
