// Why something is refused.
#pragma once
#include <stdexcept>
#include <string>

namespace sphc::test {

// What `action` throws as std::runtime_error; "" when it does not.
template <typename Action>
std::string refusal(const Action &action) {
  try {
    action();
  } catch (const std::runtime_error &error) {
    return error.what();
  }
  return "";
}

}  // namespace sphc::test
