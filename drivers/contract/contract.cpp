// The contract of sphc_source (spherecloud_capture.h), clause by clause, on every driver of a program.
#include "drivers/contract/contract.h"

#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <thread>

namespace sphc::contract {

namespace {

using Clock = std::chrono::steady_clock;
using ::testing::ValuesIn;

constexpr uint32_t kTimeoutUs = 20000;
constexpr auto kPatience = std::chrono::seconds(10);  // for a capture to come at all

// The consumer sets struct_size; a driver insists on it.
sphc_capture emptyCapture() {
  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  return capture;
}

class DriverContract : public ::testing::TestWithParam<Driver> {
 protected:
  void SetUp() override {
    opened_ = GetParam().open();
    ASSERT_NE(opened_.handle, nullptr);
  }

  static sphc_status start(const OpenedDriver &driver) { return driver.source.start(driver.source.self); }
  sphc_status start() const { return start(opened_); }
  void stop() const { opened_.source.stop(opened_.source.self); }
  void release(const sphc_capture &capture) const { opened_.source.release(opened_.source.self, &capture); }
  const char *message() const { return opened_.source.message(opened_.source.self); }

  // Asks again while there is nothing yet.
  static sphc_status acquire(const OpenedDriver &driver, sphc_capture *capture) {
    const Clock::time_point give_up = Clock::now() + kPatience;
    sphc_status status = SPHC_AGAIN;
    while (status == SPHC_AGAIN && Clock::now() < give_up)
      status = driver.source.acquire(driver.source.self, kTimeoutUs, capture);
    return status;
  }
  sphc_status acquire(sphc_capture *capture) const { return acquire(opened_, capture); }

  // Fills the loan limit.
  std::vector<sphc_capture> acquireAll() const {
    std::vector<sphc_capture> loans(opened_.source.loan_limit, emptyCapture());
    for (sphc_capture &loan : loans) EXPECT_EQ(acquire(&loan), SPHC_OK) << message();
    return loans;
  }

  // Acquire without a timeout until it says something other than "nothing yet".
  void expectLimitReached() const {
    sphc_capture capture = emptyCapture();
    EXPECT_EQ(acquire(&capture), SPHC_E_STATE);
    EXPECT_STRNE(message(), "");
  }

  // Whether an acquire that gives nothing comes back so soon.  A busy machine makes some of them longer, not all.
  bool givesUpWithin(Clock::duration most, uint32_t timeout_us) const {
    for (int i = 0; i < 10; ++i) {
      sphc_capture capture = emptyCapture();
      const Clock::time_point begin = Clock::now();
      EXPECT_EQ(opened_.source.acquire(opened_.source.self, timeout_us, &capture), SPHC_AGAIN) << message();
      if (Clock::now() - begin < most) return true;
    }
    return false;
  }

  static bool ends() { return GetParam().captures_until_end != 0 || GetParam().may_end; }

  // Up to `count` captures, each shown and then released.  Fewer only where the driver has an end.
  template <typename Visit>
  void forEachCapture(uint32_t count, Visit visit) const {
    for (uint32_t i = 0; i < count; ++i) {
      sphc_capture capture = emptyCapture();
      const sphc_status status = acquire(&capture);
      if (status == SPHC_END) {
        EXPECT_TRUE(ends()) << "SPHC_END after " << i << " captures of a driver that is said to be endless";
        return;
      }
      ASSERT_EQ(status, SPHC_OK) << message();
      visit(capture);
      release(capture);
    }
  }

  OpenedDriver opened_;
};

// Touches every byte, so that a sanitizer sees a buffer that is too short.
uint64_t checksum(const sphc_image &image) {
  const uint32_t pixel_bytes = sphc_format_bytes(image.format);
  uint64_t sum = 0;
  for (uint32_t y = 0; y < image.height; ++y) {
    const uint8_t *row = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    for (uint32_t i = 0; i < image.width * pixel_bytes; ++i) sum = 31 * sum + row[i];
  }
  return sum;
}

// ---- the struct ------------------------------------------------------------------------------------------------

TEST_P(DriverContract, FillsEveryFieldOfTheSource) {
  EXPECT_EQ(opened_.source.struct_size, sizeof(sphc_source));
  EXPECT_GE(opened_.source.loan_limit, 2u) << "one of each stream must fit";
  EXPECT_NE(opened_.source.self, nullptr);
  EXPECT_NE(opened_.source.start, nullptr);
  EXPECT_NE(opened_.source.acquire, nullptr);
  EXPECT_NE(opened_.source.release, nullptr);
  EXPECT_NE(opened_.source.stop, nullptr);
  ASSERT_NE(opened_.source.message, nullptr);
}

TEST_P(DriverContract, HasAMessageInEveryState) {
  EXPECT_NE(message(), nullptr);
  ASSERT_EQ(start(), SPHC_OK);
  EXPECT_NE(message(), nullptr);
  stop();
  EXPECT_NE(message(), nullptr);
}

// ---- states ----------------------------------------------------------------------------------------------------

TEST_P(DriverContract, RefusesToAcquireBeforeStart) {
  sphc_capture capture = emptyCapture();
  EXPECT_EQ(acquire(&capture), SPHC_E_STATE);
  EXPECT_STRNE(message(), "");
}

TEST_P(DriverContract, RefusesToStartTwiceAndGoesOn) {
  ASSERT_EQ(start(), SPHC_OK) << message();
  EXPECT_EQ(start(), SPHC_E_STATE);
  EXPECT_STRNE(message(), "");
  sphc_capture capture = emptyCapture();
  EXPECT_EQ(acquire(&capture), SPHC_OK) << message();
}

TEST_P(DriverContract, RefusesToAcquireAfterStop) {
  ASSERT_EQ(start(), SPHC_OK);
  stop();
  sphc_capture capture = emptyCapture();
  EXPECT_EQ(acquire(&capture), SPHC_E_STATE);
}

TEST_P(DriverContract, StopsWhenStoppedWithoutEffect) {
  stop();
  stop();
  EXPECT_EQ(start(), SPHC_OK) << message();
  stop();
  stop();
}

TEST_P(DriverContract, StartsAgainAndAgain) {
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(start(), SPHC_OK) << message();
    forEachCapture(4, [](const sphc_capture &) {});
    stop();
  }
}

TEST_P(DriverContract, ClosesWhileRunningWithLoansOut) {
  ASSERT_EQ(start(), SPHC_OK);
  sphc_capture capture = emptyCapture();
  ASSERT_EQ(acquire(&capture), SPHC_OK);
  opened_.handle.reset();  // a sanitizer would see what is left behind
}

// ---- loans -----------------------------------------------------------------------------------------------------

TEST_P(DriverContract, LendsUpToTheLimitAndAgainAfterRelease) {
  ASSERT_EQ(start(), SPHC_OK);
  const std::vector<sphc_capture> loans = acquireAll();
  expectLimitReached();
  release(loans.front());
  sphc_capture capture = emptyCapture();
  EXPECT_EQ(acquire(&capture), SPHC_OK) << message();
  expectLimitReached();
}

TEST_P(DriverContract, KeepsEachLoanApartFromTheOthers) {
  ASSERT_EQ(start(), SPHC_OK);
  std::vector<sphc_capture> loans(opened_.source.loan_limit, emptyCapture());
  std::vector<uint64_t> sums;
  std::set<const void *> buffers;
  for (sphc_capture &loan : loans) {
    ASSERT_EQ(acquire(&loan), SPHC_OK);
    sums.push_back(checksum(loan.image));
    buffers.insert(loan.image.data);
  }
  EXPECT_EQ(buffers.size(), loans.size());
  expectLimitReached();  // which must not cost one of those that are out
  for (size_t i = 0; i < loans.size(); ++i) EXPECT_EQ(checksum(loans[i].image), sums[i]) << "loan " << i;
}

// A ring that goes on to its next buffer whether that is on loan or not.
TEST_P(DriverContract, LeavesALoanAloneWhileOthersComeAndGo) {
  ASSERT_EQ(start(), SPHC_OK);
  sphc_capture held = emptyCapture();
  ASSERT_EQ(acquire(&held), SPHC_OK);
  const uint64_t sum = checksum(held.image);
  const uint32_t rounds = 3 * (opened_.source.loan_limit + GetParam().spare_buffers);
  uint32_t at = 0;
  forEachCapture(rounds, [&](const sphc_capture &capture) {
    ++at;
    EXPECT_NE(capture.image.data, held.image.data) << "capture " << at << " after the one on loan";
  });
  EXPECT_EQ(checksum(held.image), sum) << "the image on loan changed";
  release(held);
}

TEST_P(DriverContract, IgnoresASecondRelease) {
  ASSERT_EQ(start(), SPHC_OK);
  const std::vector<sphc_capture> loans = acquireAll();
  release(loans.front());
  release(loans.front());
  sphc_capture capture = emptyCapture();
  ASSERT_EQ(acquire(&capture), SPHC_OK);
  release(loans.front());  // its place has a new tenant now
  expectLimitReached();
}

TEST_P(DriverContract, IgnoresTheReleaseOfWhatItNeverLent) {
  ASSERT_EQ(start(), SPHC_OK);
  const std::vector<sphc_capture> loans = acquireAll();
  sphc_capture foreign{};
  release(foreign);
  foreign = loans.front();
  foreign.token = ~foreign.token;
  release(foreign);
  opened_.source.release(opened_.source.self, nullptr);
  expectLimitReached();
}

TEST_P(DriverContract, IgnoresTheReleaseOfAnothersCapture) {
  if (!GetParam().opens_twice) GTEST_SKIP() << "cannot be opened twice";
  const OpenedDriver other = GetParam().open();
  ASSERT_EQ(start(), SPHC_OK);
  ASSERT_EQ(start(other), SPHC_OK);
  const std::vector<sphc_capture> loans = acquireAll();
  sphc_capture foreign = emptyCapture();
  ASSERT_EQ(acquire(other, &foreign), SPHC_OK);
  release(foreign);
  expectLimitReached();
  for (const sphc_capture &loan : loans) {  // tokens of two sources may well be equal; their images are not
    foreign.token = loan.token;
    release(foreign);
  }
  expectLimitReached();
}

TEST_P(DriverContract, EndsEveryLoanAtStop) {
  ASSERT_EQ(start(), SPHC_OK);
  const std::vector<sphc_capture> old_loans = acquireAll();
  stop();
  release(old_loans.front());
  ASSERT_EQ(start(), SPHC_OK);
  const std::vector<sphc_capture> loans = acquireAll();
  for (const sphc_capture &old : old_loans) release(old);
  expectLimitReached();
}

// ---- captures --------------------------------------------------------------------------------------------------

TEST_P(DriverContract, FillsEveryCapture) {
  ASSERT_EQ(start(), SPHC_OK);
  forEachCapture(20, [](const sphc_capture &capture) {
    EXPECT_EQ(capture.struct_size, sizeof capture);
    EXPECT_TRUE(capture.stream == SPHC_STREAM_COLOR || capture.stream == SPHC_STREAM_DEPTH);
    EXPECT_EQ(capture.reserved, 0u);
  });
}

TEST_P(DriverContract, GivesImagesThatFitTheirStream) {
  ASSERT_EQ(start(), SPHC_OK);
  forEachCapture(20, [](const sphc_capture &capture) {
    const sphc_image &image = capture.image;
    ASSERT_NE(image.data, nullptr);
    const bool is_depth = capture.stream == SPHC_STREAM_DEPTH;
    const bool is_color_format =
        image.format == SPHC_FORMAT_GRAY8 || image.format == SPHC_FORMAT_RGB8 || image.format == SPHC_FORMAT_BGR8;
    EXPECT_TRUE(is_depth ? image.format == SPHC_FORMAT_DEPTH16 : is_color_format)
        << "format " << image.format << "; colour is GRAY8, RGB8 or BGR8, depth DEPTH16 (docs/drivers.md)";
    EXPECT_GE(std::min(image.width, image.height), SPHC_CAMERA_MIN_PX);
    EXPECT_LE(std::max(image.width, image.height), SPHC_CAMERA_MAX_PX);
    const uint32_t pixel_bytes = is_depth ? 2 : image.format == SPHC_FORMAT_GRAY8 ? 1 : 3;
    EXPECT_GE(image.stride_bytes, image.width * pixel_bytes);
    if (is_depth) {
      EXPECT_EQ(reinterpret_cast<uintptr_t>(image.data) % 2, 0u);
      EXPECT_EQ(image.stride_bytes % 2, 0u);
    }
    checksum(image);
  });
}

TEST_P(DriverContract, GivesAmplitudesThatFitTheirDepth) {
  ASSERT_EQ(start(), SPHC_OK);
  uint32_t with_amplitudes = 0;
  forEachCapture(20, [&](const sphc_capture &capture) {
    const sphc_image &amplitude = capture.amplitude;
    if (!amplitude.data) {
      EXPECT_EQ(amplitude.width | amplitude.height | amplitude.stride_bytes | uint32_t(amplitude.format), 0u);
      return;
    }
    ++with_amplitudes;
    EXPECT_EQ(capture.stream, SPHC_STREAM_DEPTH);
    EXPECT_EQ(amplitude.width, capture.image.width);
    EXPECT_EQ(amplitude.height, capture.image.height);
    const uint32_t pixel_bytes = amplitude.format == SPHC_FORMAT_GRAY8 ? 1 : 2;
    EXPECT_GE(amplitude.stride_bytes, amplitude.width * pixel_bytes);
    EXPECT_TRUE(amplitude.format == SPHC_FORMAT_GRAY8 ||
                (amplitude.format >= SPHC_FORMAT_GRAY10 && amplitude.format <= SPHC_FORMAT_GRAY16));
    checksum(amplitude);
  });
  EXPECT_EQ(with_amplitudes > 0, GetParam().gives_amplitudes) << "Driver::gives_amplitudes says otherwise";
}

TEST_P(DriverContract, KeepsSizeAndFormatOfAStream) {
  ASSERT_EQ(start(), SPHC_OK);
  std::map<sphc_stream, sphc_image> first;
  forEachCapture(20, [&](const sphc_capture &capture) {
    const sphc_image &image = capture.image;
    const sphc_image &expected = first.emplace(capture.stream, image).first->second;
    EXPECT_EQ(image.width, expected.width);
    EXPECT_EQ(image.height, expected.height);
    EXPECT_EQ(image.stride_bytes, expected.stride_bytes);
    EXPECT_EQ(image.format, expected.format);
  });
  EXPECT_EQ(first.size(), GetParam().streams) << "every stream must come";
}

TEST_P(DriverContract, GivesCapturesInOrderOfTime) {
  ASSERT_EQ(start(), SPHC_OK);
  int64_t last_ns = INT64_MIN;
  std::map<sphc_stream, int64_t> last_of_stream;
  forEachCapture(30, [&](const sphc_capture &capture) {
    EXPECT_GE(capture.time_ns, last_ns);
    last_ns = capture.time_ns;
    const auto [it, is_first] = last_of_stream.emplace(capture.stream, capture.time_ns);
    if (!is_first) {
      EXPECT_GT(capture.time_ns, it->second) << "two of one stream at one time";
    }
    it->second = capture.time_ns;
  });
}

// By the clock that a capture names; nothing where it is the source's own.
std::optional<int64_t> nowBy(sphc_clock_id clock) {
  if (clock == SPHC_CLOCK_SOURCE) return std::nullopt;
  timespec now{};
  clock_gettime(clock == SPHC_CLOCK_MONOTONIC ? CLOCK_MONOTONIC : CLOCK_BOOTTIME, &now);
  return int64_t{now.tv_sec} * 1000000000 + now.tv_nsec;
}

TEST_P(DriverContract, GivesTimesInNanosecondsOfOneClock) {
  constexpr int64_t kMostAgoNs = 60000000000;
  ASSERT_EQ(start(), SPHC_OK);
  std::optional<sphc_clock_id> clock;
  forEachCapture(20, [&](const sphc_capture &capture) {
    EXPECT_TRUE(capture.clock >= SPHC_CLOCK_SOURCE && capture.clock <= SPHC_CLOCK_BOOTTIME) << capture.clock;
    EXPECT_TRUE(capture.time_point >= SPHC_TIME_MIDDLE && capture.time_point <= SPHC_TIME_ARRIVAL)
        << capture.time_point;
    EXPECT_EQ(capture.clock, clock.value_or(capture.clock))
        << "both streams need one clock: the pairer takes no other";
    clock = capture.clock;
    const std::optional<int64_t> now_ns = nowBy(capture.clock);
    if (!now_ns || !GetParam().is_live) return;
    EXPECT_LE(capture.time_ns, *now_ns) << "in the future: another clock, or no nanoseconds";
    EXPECT_GE(capture.time_ns, *now_ns - kMostAgoNs) << "long ago: another clock, or no nanoseconds";
  });
}

TEST_P(DriverContract, CountsTheCapturesOfAStreamUpwards) {
  ASSERT_EQ(start(), SPHC_OK);
  std::map<sphc_stream, uint32_t> last;
  forEachCapture(30, [&](const sphc_capture &capture) {
    const auto [it, is_first] = last.emplace(capture.stream, capture.sequence);
    if (!is_first) {
      EXPECT_GT(capture.sequence, it->second);
    }
    it->second = capture.sequence;
  });
}

TEST_P(DriverContract, ReusesItsMemory) {
  ASSERT_EQ(start(), SPHC_OK);
  std::set<const void *> buffers;
  forEachCapture(150, [&](const sphc_capture &capture) { buffers.insert(capture.image.data); });
  EXPECT_LE(buffers.size(), opened_.source.loan_limit + GetParam().spare_buffers);
}

// ---- failure, end, time ----------------------------------------------------------------------------------------

TEST_P(DriverContract, LeavesTheCaptureUntouchedWhenItGivesNone) {
  sphc_capture capture;
  std::memset(&capture, 0x5a, sizeof capture);
  capture.struct_size = sizeof capture;
  const sphc_capture before = capture;
  EXPECT_EQ(acquire(&capture), SPHC_E_STATE);
  EXPECT_EQ(std::memcmp(&capture, &before, sizeof capture), 0) << "stopped";
  ASSERT_EQ(start(), SPHC_OK);
  const std::vector<sphc_capture> loans = acquireAll();
  EXPECT_EQ(acquire(&capture), SPHC_E_STATE);
  EXPECT_EQ(std::memcmp(&capture, &before, sizeof capture), 0) << "limit reached";
}

TEST_P(DriverContract, RefusesANullCapture) {
  ASSERT_EQ(start(), SPHC_OK);
  EXPECT_EQ(opened_.source.acquire(opened_.source.self, 0, nullptr), SPHC_E_ARGUMENT);
  EXPECT_STRNE(message(), "");
}

// Another header's sphc_capture may be smaller than what the driver would write.
TEST_P(DriverContract, RefusesACaptureOfAnotherSize) {
  ASSERT_EQ(start(), SPHC_OK);
  constexpr uint32_t kBytes = sizeof(sphc_capture);
  for (const uint32_t struct_size : {0u, kBytes - 8, kBytes + 8}) {
    sphc_capture capture;
    std::memset(&capture, 0x5a, sizeof capture);
    capture.struct_size = struct_size;
    const sphc_capture before = capture;
    EXPECT_EQ(opened_.source.acquire(opened_.source.self, 0, &capture), SPHC_E_STRUCT_SIZE) << struct_size;
    EXPECT_STRNE(message(), "");
    EXPECT_EQ(std::memcmp(&capture, &before, sizeof capture), 0) << struct_size;
  }
}

TEST_P(DriverContract, EndsOnceAllAreGivenAndStartsFromTheBeginning) {
  if (GetParam().captures_until_end == 0) GTEST_SKIP() << "endless";
  for (int run = 0; run < 2; ++run) {
    ASSERT_EQ(start(), SPHC_OK);
    uint32_t count = 0;
    forEachCapture(GetParam().captures_until_end + 10, [&](const sphc_capture &) { ++count; });
    EXPECT_EQ(count, GetParam().captures_until_end);
    sphc_capture capture = emptyCapture();
    EXPECT_EQ(acquire(&capture), SPHC_END);
    EXPECT_EQ(acquire(&capture), SPHC_END) << "and stays there";
    stop();
  }
}

TEST_P(DriverContract, ComesBackWithinTheTimeout) {
  constexpr auto kSlack = std::chrono::seconds(2);  // a loaded machine, a sanitizer, a decoder
  ASSERT_EQ(start(), SPHC_OK);
  for (const uint32_t timeout_us : {0u, 1u, 1000u, 20000u}) {
    const Clock::time_point begin = Clock::now();
    sphc_capture capture = emptyCapture();
    const sphc_status status = opened_.source.acquire(opened_.source.self, timeout_us, &capture);
    EXPECT_LT(Clock::now() - begin, std::chrono::microseconds(timeout_us) + kSlack);
    EXPECT_TRUE(status == SPHC_OK || status == SPHC_AGAIN) << status;
    if (status == SPHC_OK) release(capture);
  }
}

// Without a timeout: nothing yet, or a capture that waits already.  One that blocks until the next capture comes
// never says SPHC_AGAIN, and takes as long as the captures' own times are apart.  One answer in time is enough: a
// busy machine delays others.
TEST_P(DriverContract, DoesNotWaitForTheNextCapture) {
  if (ends()) GTEST_SKIP() << "a recording may take its time to read an image";
  struct Last {
    Clock::time_point came;
    int64_t time_ns;
  };
  constexpr auto kAtOnce = std::chrono::milliseconds(2);  // of a source that makes captures whenever it is asked
  std::map<sphc_stream, Last> last;
  ASSERT_EQ(start(), SPHC_OK);
  for (int i = 0; i < 60; ++i) {
    sphc_capture capture = emptyCapture();
    const sphc_status status = opened_.source.acquire(opened_.source.self, 0, &capture);
    const Clock::time_point now = Clock::now();
    if (status == SPHC_AGAIN) return;
    ASSERT_EQ(status, SPHC_OK) << message();
    release(capture);
    const auto [it, is_first] = last.emplace(capture.stream, Last{now, capture.time_ns});
    const auto apart = std::chrono::nanoseconds(capture.time_ns - it->second.time_ns);
    if (!is_first && now - it->second.came < std::max<Clock::duration>(apart / 2, kAtOnce)) return;
    it->second = {now, capture.time_ns};
  }
  ADD_FAILURE() << "with a timeout of 0 us every acquire blocks for the next capture";
}

TEST_P(DriverContract, SaysAgainWhileNothingComes) {
  if (!opened_.stall) GTEST_SKIP() << "cannot stall";
  ASSERT_EQ(start(), SPHC_OK);
  forEachCapture(2, [](const sphc_capture &) {});
  opened_.stall();
  sphc_capture capture = emptyCapture();
  sphc_status status = SPHC_OK;
  for (int on_their_way = 0; status == SPHC_OK && on_their_way < 64; ++on_their_way) {
    status = opened_.source.acquire(opened_.source.self, kTimeoutUs, &capture);
    if (status == SPHC_OK) release(capture);
  }
  EXPECT_EQ(status, SPHC_AGAIN) << message();
  EXPECT_TRUE(givesUpWithin(std::chrono::milliseconds(5), 0));
  EXPECT_TRUE(givesUpWithin(std::chrono::microseconds(2 * kTimeoutUs), kTimeoutUs));
}

TEST_P(DriverContract, IsLostOnceUnplugged) {
  if (!opened_.unplug) GTEST_SKIP() << "cannot be unplugged";
  ASSERT_EQ(start(), SPHC_OK);
  sphc_capture kept = emptyCapture();
  ASSERT_EQ(acquire(&kept), SPHC_OK) << message();
  const uint64_t sum = checksum(kept.image);
  opened_.unplug();
  sphc_capture capture = emptyCapture();
  sphc_status status = SPHC_OK;
  for (int on_their_way = 0; status == SPHC_OK && on_their_way < 64; ++on_their_way) {
    status = acquire(&capture);
    if (status == SPHC_OK) release(capture);
  }
  EXPECT_EQ(status, SPHC_E_DEVICE_LOST) << message();
  EXPECT_STRNE(message(), "");
  EXPECT_EQ(acquire(&capture), SPHC_E_DEVICE_LOST) << "and stays so";
  EXPECT_EQ(checksum(kept.image), sum) << "a loan goes on until its release";
  release(kept);
  stop();
  EXPECT_LT(start(), 0) << "only opening helps";
}

// Of this process.
size_t threadsAndFiles() {
  const auto entries = [](const char *folder) {
    return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
  };
  return static_cast<size_t>(entries("/proc/self/task") + entries("/proc/self/fd"));
}

TEST_P(DriverContract, LeavesNoThreadAndNoFileBehind) {
  opened_ = {};
  const size_t before = threadsAndFiles();
  for (int i = 0; i < 3; ++i) {
    opened_ = GetParam().open();
    ASSERT_EQ(start(), SPHC_OK);
    forEachCapture(2, [](const sphc_capture &) {});
    opened_ = {};
  }
  // The kernel lists a thread for a moment after it was joined.
  const Clock::time_point end = Clock::now() + kPatience;
  while (threadsAndFiles() > before && Clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_LE(threadsAndFiles(), before);
}

TEST_P(DriverContract, RunsBesideAnotherOfItsKind) {
  if (!GetParam().opens_twice) GTEST_SKIP() << "cannot be opened twice";
  const OpenedDriver other = GetParam().open();
  ASSERT_EQ(start(), SPHC_OK);
  ASSERT_EQ(start(other), SPHC_OK);
  stop();
  sphc_capture capture = emptyCapture();
  EXPECT_EQ(acquire(other, &capture), SPHC_OK);
}

INSTANTIATE_TEST_SUITE_P(Drivers, DriverContract, ValuesIn(driversUnderTest()),
                         [](const auto &suite) { return suite.param.name; });

}  // namespace

}  // namespace sphc::contract
