// Hostile input is refused with words, or taken.
#pragma once
#include <stdexcept>

#include "tests/fuzz/targets.h"

namespace sphc::fuzz {

template <typename Action>
void refuseOrDo(const Action &action) {
  try {
    action();
  } catch (const std::runtime_error &error) {
    if (!*error.what()) broken("a refusal explains itself");
  }
}

}  // namespace sphc::fuzz
