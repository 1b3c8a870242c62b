#include "command_runner.h"

#include <stdlib.h>
#include <sys/wait.h>

#include <sstream>

#include "host/report/file.h"
#include "tests/support/refusals/record.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

// What the command says it cannot do: "spherecloud build: why".
void record(const Answer &answer) {
  std::istringstream lines(answer.err);
  for (std::string line; std::getline(lines, line);) {
    const size_t colon = line.find(": ");
    if (line.rfind("spherecloud", 0) == 0 && colon != std::string::npos)
      test::recordRefusal(line.substr(0, colon), "exit " + std::to_string(answer.exit_code),
                          line.substr(colon + 2));
  }
}

}  // namespace

std::vector<nlohmann::json> jsonLines(const std::string &text) {
  std::vector<nlohmann::json> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
  return all;
}

std::string fileText(const std::string &path) {
  const auto bytes = readBytes(path);
  return {bytes.begin(), bytes.end()};
}

Answer runCommand(const std::string &arguments) { return runProgram(SPHC_COMMAND, arguments); }

Answer runProgram(const std::string &program, const std::string &arguments) {
  const test::TempFolder folder;
  const std::string command =
      program + " " + arguments + " >" + (folder / "out") + " 2>" + (folder / "err") + " </dev/null";
  const int status = std::system(command.c_str());
  Answer answer = {WIFEXITED(status) ? WEXITSTATUS(status) : -1, fileText(folder / "out"),
                   fileText(folder / "err")};
  if (answer.exit_code > 0) record(answer);
  return answer;
}

}  // namespace sphc::host
