// Writes down what the code under test throws.  The linker's --wrap brings every throw here (CMakeLists.txt).
#include <exception>
#include <typeinfo>

#include "host/base/usage_error.h"
#include "host/recording/failure.h"
#include "tests/support/refusals/record.h"

namespace sphc::test {
namespace {

const std::exception *asException(std::type_info *type, void *thrown) {
  void *object = thrown;
  const std::type_info &wanted = typeid(std::exception);
  return wanted.__do_catch(type, &object, 1) ? static_cast<const std::exception *>(object) : nullptr;
}

// What the command makes of it: host/cli/common/program.cpp.
std::string codeOf(const std::exception &error) {
  if (const auto *failure = dynamic_cast<const recording::Failure *>(&error))
    return sphc_status_name(failure->status());
  return dynamic_cast<const host::UsageError *>(&error) ? "exit 2" : "exit 1";
}

}  // namespace
}  // namespace sphc::test

extern "C" {
[[noreturn]] void __real___cxa_throw(void *thrown, std::type_info *type, void (*destroy)(void *));
[[noreturn]] void __wrap___cxa_throw(void *thrown, std::type_info *type, void (*destroy)(void *)) {
  using namespace sphc::test;
  if (recordsRefusals()) {
    if (const std::exception *error = asException(type, thrown)) recordRefusal("", codeOf(*error), error->what());
  }
  __real___cxa_throw(thrown, type, destroy);
}
}
