// How this driver fails inside: by exception, which the C functions turn into a status and a message.
#pragma once

#include <spherecloud/spherecloud.h>

#include <stdexcept>
#include <string>

namespace sphc::recording {

class Failure : public std::runtime_error {
 public:
  Failure(sphc_status status, const std::string &text) : std::runtime_error(text), status_(status) {}
  sphc_status status() const noexcept { return status_; }

 private:
  sphc_status status_;
};

// Cut to fit; `message` may be null.
void setMessage(sphc_message *message, const char *text) noexcept;

// Sets the message from the exception in flight and gives its status; only inside a catch block.
sphc_status explainException(sphc_message *message) noexcept;

// The end of a path that is too long for a message.
std::string shortPath(const std::string &path);

// Runs the body of a C function: no exception gets out.
template <typename Body>
sphc_status guarded(sphc_message *message, Body &&body) noexcept {
  try {
    return body();
  } catch (...) {
    return explainException(message);
  }
}

}  // namespace sphc::recording
