// Wrong use of a program: options that parse but contradict each other, or ask for what cannot be.
#pragma once
#include <stdexcept>

namespace sphc::host {

class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A value that a function of C does not take.  Where an option gave it, that is wrong use too.
class ArgumentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sphc::host
