// Ctrl-C, a terminal that closes and a polite kill end a loop, not the program: what was begun is brought to its
// end.
#pragma once
#include <array>
#include <csignal>
#include <stdexcept>

namespace sphc::host {

class Interrupt {
 public:
  Interrupt() {
    flag() = 0;
    for (size_t i = 0; i < kSignals.size(); ++i) {
      before_[i] = std::signal(kSignals[i], [](int) { flag() = 1; });
      // nohup asks for this one not to be heard.
      if (kSignals[i] == SIGHUP && before_[i] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
  }
  ~Interrupt() {
    for (size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], before_[i]);
  }
  Interrupt(const Interrupt &) = delete;
  Interrupt &operator=(const Interrupt &) = delete;

  bool came() const { return flag() != 0; }
  // For what cannot be brought to an end early: throws std::runtime_error where it came.
  void throwIfCame() const {
    if (came()) throw std::runtime_error("interrupted; what was begun is removed");
  }

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  static volatile std::sig_atomic_t &flag() {
    static volatile std::sig_atomic_t flag = 0;
    return flag;
  }
  std::array<void (*)(int), 3> before_ = {};
};

}  // namespace sphc::host
