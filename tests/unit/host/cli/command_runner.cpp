#include "command_runner.h"

#include <stdlib.h>
#include <sys/wait.h>

#include "host/report/file.h"
#include "tests/unit/host/tiny_map.h"

namespace sphc::host {
namespace {

std::string textOf(const std::string &path) {
  const auto bytes = readBytes(path);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Answer runCommand(const std::string &arguments) { return runProgram(SPHC_COMMAND, arguments); }

Answer runProgram(const std::string &program, const std::string &arguments) {
  const TempFolder folder;
  const std::string command =
      program + " " + arguments + " >" + (folder / "out") + " 2>" + (folder / "err") + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(folder / "out"), textOf(folder / "err")};
}

}  // namespace sphc::host
