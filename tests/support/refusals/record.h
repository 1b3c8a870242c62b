// What tests are refused, written down for docs/error_cases.md: one line of a file for each refusal, in the folder
// that the environment variable SPHC_REFUSALS names.  Without it nothing is written.
#pragma once
#include <string>

#include "spherecloud/spherecloud.h"

namespace sphc::test {

bool recordsRefusals();

// `where` is the function or the command that refused, or empty; `code` is a status or "exit 1".
void recordRefusal(const std::string &where, const std::string &code, const std::string &message);

// Calls `call(&message)`, with a message where the caller gave none, and writes down a failure.
template <typename Call>
sphc_status recordedCall(const char *where, sphc_message *message, const Call &call) {
  if (!recordsRefusals()) return call(message);
  sphc_message own = {};
  sphc_message *told = message ? message : &own;
  const sphc_status status = call(told);
  if (status < 0) recordRefusal(where, sphc_status_name(status), told->text);
  return status;
}

// The same of a function whose object keeps the message: `messageOf(object)`.
template <typename Object, typename Call>
sphc_status recordedCallOf(const char *where, const Object *object, const char *(*messageOf)(const Object *),
                           const Call &call) {
  const sphc_status status = call();
  if (status < 0 && object && recordsRefusals()) recordRefusal(where, sphc_status_name(status), messageOf(object));
  return status;
}

}  // namespace sphc::test
