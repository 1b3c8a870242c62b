// Ctrl-C, a terminal that closes and a polite kill end a loop, not the program: what was begun is brought to its
// end.
#pragma once
#include <array>
#include <csignal>

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

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  static volatile std::sig_atomic_t &flag() {
    static volatile std::sig_atomic_t flag = 0;
    return flag;
  }
  std::array<void (*)(int), 3> before_ = {};
};

}  // namespace sphc::host
