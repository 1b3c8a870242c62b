#include "tests/support/refusals/record.h"

#include <errno.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>

namespace sphc::test {
namespace {

// The file of this program, empty when the program begins.  A test may make files small for a while, as a full disk
// does: what cannot be written then is written later.
class Records {
 public:
  Records() {
    const char *folder = std::getenv("SPHC_REFUSALS");
    if (!folder) return;
    const std::string path = std::string(folder) + "/" + program_invocation_short_name + ".tsv";
    file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  }
  ~Records() {
    writeOut();
    if (!pending_.empty()) std::abort();  // the page would lack them
  }
  bool isOpen() const { return file_ >= 0; }
  void add(const std::string &line) {
    const std::lock_guard<std::mutex> lock(mutex_);
    pending_ += line;
    writeOut();
  }

 private:
  void writeOut() {
    const ssize_t written = pending_.empty() ? 0 : write(file_, pending_.data(), pending_.size());
    if (written > 0) pending_.erase(0, static_cast<size_t>(written));
  }

  int file_ = -1;
  std::mutex mutex_;
  std::string pending_;
};
Records records;

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

bool recordsRefusals() { return records.isOpen(); }

void recordRefusal(const std::string &where, const std::string &code, const std::string &message) {
  const std::string test = currentCase();
  if (!recordsRefusals() || test.empty()) return;
  records.add(test + "\t" + where + "\t" + code + "\t" + oneField(message) + "\n");
}

}  // namespace sphc::test
