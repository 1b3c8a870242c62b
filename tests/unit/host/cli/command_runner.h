// Runs the spherecloud command as a user does.
#pragma once
#include <string>

namespace sphc::host {

struct Answer {
  int exit_code = -1;
  std::string out, err;
};
// `arguments` as typed in a shell.  Needs SPHC_COMMAND, the path of the command.
Answer runCommand(const std::string &arguments);
// The same of any program.
Answer runProgram(const std::string &program, const std::string &arguments);

// A folder of its own, removed at the end.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder &) = delete;
  TempFolder &operator=(const TempFolder &) = delete;
  std::string operator/(const std::string &name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

// A small valid map of made-up points.
void writeTinyMap(const std::string &path, uint32_t points);

}  // namespace sphc::host
