#include "host/cli/record_guide.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "tests/unit/host/guide/made_up_wall.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

// A disk that is full, in the place of stdout.
class FullOutput {
 public:
  FullOutput() : kept_((std::fflush(stdout), dup(STDOUT_FILENO))) {
    const int full = open("/dev/full", O_WRONLY);
    dup2(full, STDOUT_FILENO);
    close(full);
  }
  ~FullOutput() {
    dup2(kept_, STDOUT_FILENO);
    close(kept_);
    std::clearerr(stdout);
  }
  FullOutput(const FullOutput &) = delete;
  FullOutput &operator=(const FullOutput &) = delete;

 private:
  int kept_;
};

CapturePair pairAt(int64_t time_ns, MadeUpWall *wall) {
  const sphc_localizer_frame frame = wall->view(0, time_ns);
  CapturePair pair;
  pair.color.stream = SPHC_STREAM_COLOR;
  pair.depth.stream = SPHC_STREAM_DEPTH;
  pair.color.image = frame.color;
  pair.depth.image = frame.depth;
  pair.color.time_ns = pair.depth.time_ns = time_ns;
  return pair;
}

// "good" would be an advice that holds no longer.
TEST(RecordGuideTest, WhereItFailedItSaysSoAndWasNotBusy) {
  constexpr int64_t kSecond = 1000000000;
  MadeUpWall wall(1);
  Console console;
  console.json = true;
  RecordGuide guide(wallRig(), {}, true, console);
  guide.see(pairAt(kSecond, &wall));
  {
    const FullOutput full;
    guide.see(pairAt(2 * kSecond, &wall));  // waits for the first
    guide.see(pairAt(3 * kSecond, &wall));
    guide.see(pairAt(4 * kSecond, &wall));
  }
  EXPECT_THAT(guide.text(), HasSubstr("NO GUIDANCE: the output cannot be written"));
  EXPECT_EQ(guide.end(console)["skipped"], 0);
}

}  // namespace
}  // namespace sphc::host
