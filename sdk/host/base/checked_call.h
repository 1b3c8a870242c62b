// The C interface and the drivers' C functions, for code that has exceptions.
#pragma once
#include <spherecloud/spherecloud.h>

#include <stdexcept>
#include <string>

#include "host/base/usage_error.h"

namespace sphc::host {

// Calls `call(&message)` and throws on a failure: "WHAT: message"; ArgumentError where an argument is the cause.
template <typename Call>
sphc_status orThrow(const std::string &what, Call call) {
  sphc_message message = {};
  const sphc_status status = call(&message);
  if (status >= 0) return status;
  const std::string why = message.text[0] != '\0' ? message.text : sphc_status_name(status);
  if (status == SPHC_E_ARGUMENT) throw ArgumentError(what + ": " + why);
  throw std::runtime_error(what + ": " + why);
}

}  // namespace sphc::host
