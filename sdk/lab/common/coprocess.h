// A program of its own that answers over its standard input and output.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace sphc::host {

class Coprocess {
 public:
  // `arguments[0]` is the program, looked up in PATH; `patience_s` is how long it may say nothing.  Throws
  // std::runtime_error when it cannot be started.
  explicit Coprocess(const std::vector<std::string> &arguments, int patience_s = 60);
  Coprocess(const Coprocess &) = delete;
  Coprocess &operator=(const Coprocess &) = delete;
  ~Coprocess();

  // False when the program is gone or out of patience.
  bool write(const void *data, size_t size);
  bool read(void *data, size_t size);

 private:
  int socket_ = -1;
  pid_t child_ = 0;
};

// Runs a script that says SPHC when it is ready.  Null where Python, or a package that the script imports, is not
// there.
std::shared_ptr<Coprocess> startScript(const std::string &python, const std::string &script);

}  // namespace sphc::host
