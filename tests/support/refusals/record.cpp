#include "tests/support/refusals/record.h"

#include <errno.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace sphc::test {
namespace {

// The file of this program, empty when the program begins; -1 where nothing is to be written.
int openFile() {
  const char *folder = std::getenv("SPHC_REFUSALS");
  if (!folder) return -1;
  const std::string path = std::string(folder) + "/" + program_invocation_short_name + ".tsv";
  return open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
}
const int file = openFile();

std::string currentCase() {
  const auto *test = testing::UnitTest::GetInstance()->current_test_info();
  return test ? std::string(test->test_suite_name()) + "." + test->name() : "";
}

std::string oneField(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n'; }, ' ');
  return text;
}

}  // namespace

bool recordsRefusals() { return file >= 0; }

void recordRefusal(const std::string &where, const std::string &code, const std::string &message) {
  const std::string test = currentCase();
  if (!recordsRefusals() || test.empty()) return;
  const std::string line = test + "\t" + where + "\t" + code + "\t" + oneField(message) + "\n";
  if (write(file, line.data(), line.size()) != static_cast<ssize_t>(line.size())) std::abort();  // disk full
}

}  // namespace sphc::test
