// Runs the spherecloud command as a user does.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sphc::host {

struct Answer {
  int exit_code = -1;
  std::string out, err;
};
// `arguments` as typed in a shell.  Needs SPHC_COMMAND, the path of the command.
Answer runCommand(const std::string &arguments);
// The same of any program.
Answer runProgram(const std::string &program, const std::string &arguments);

// Of text with an object a line.
std::vector<nlohmann::json> jsonLines(const std::string &text);

// All of a file that is there.
std::string fileText(const std::string &path);

}  // namespace sphc::host
