// A program of its own that answers over its standard input and output.
#pragma once
#include <sys/types.h>

#include <cstddef>
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

}  // namespace sphc::host
