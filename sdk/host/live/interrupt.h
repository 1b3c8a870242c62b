// Ctrl-C ends a loop, not the program: what was begun is brought to its end.
#pragma once
#include <csignal>

namespace sphc::host {

class Interrupt {
 public:
  Interrupt() : before_(std::signal(SIGINT, [](int) { flag() = 1; })) { flag() = 0; }
  ~Interrupt() { std::signal(SIGINT, before_); }
  Interrupt(const Interrupt &) = delete;
  Interrupt &operator=(const Interrupt &) = delete;

  bool came() const { return flag() != 0; }

 private:
  static volatile std::sig_atomic_t &flag() {
    static volatile std::sig_atomic_t flag = 0;
    return flag;
  }
  void (*before_)(int);
};

}  // namespace sphc::host
