// Wrong use of a program: options that parse but contradict each other, or ask for what cannot be.
#pragma once
#include <stdexcept>

namespace sphc::host {

class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sphc::host
