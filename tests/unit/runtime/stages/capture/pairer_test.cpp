#include "runtime/stages/capture/pairer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr int64_t kMillisecondNs = 1000000;

sphc_capture capture(sphc_stream stream, int64_t time_ms, uint64_t token = 0) {
  sphc_capture c = {};
  c.struct_size = sizeof c;
  c.stream = stream;
  c.time_ns = time_ms * kMillisecondNs;
  c.token = token ? token : static_cast<uint64_t>(time_ms);
  return c;
}
sphc_capture color(int64_t time_ms) { return capture(SPHC_STREAM_COLOR, time_ms); }
sphc_capture depth(int64_t time_ms) { return capture(SPHC_STREAM_DEPTH, time_ms); }

Pairer makePairer(uint32_t slots = 4, int64_t tolerance_ms = 20) {
  return Pairer({sizeof(sphc_pairer_config), slots, tolerance_ms * kMillisecondNs});
}

struct Pair {
  sphc_capture color = {}, depth = {};
};

// Everything that comes out now: "c10+d11" a pair, "-d5" a drop.
std::string drain(Pairer *pairer) {
  std::string out;
  for (int guard = 0; guard < 100; ++guard) {
    Pair pair;
    sphc_capture dropped = {};
    const sphc_status status = pairer->pop(&pair.color, &pair.depth, &dropped);
    if (status == SPHC_OK) {
      EXPECT_EQ(dropped.stream, SPHC_STREAM_NONE);
      EXPECT_EQ(pair.color.stream, SPHC_STREAM_COLOR);
      EXPECT_EQ(pair.depth.stream, SPHC_STREAM_DEPTH);
      out += "c" + std::to_string(pair.color.time_ns / kMillisecondNs) + "+d" +
             std::to_string(pair.depth.time_ns / kMillisecondNs) + " ";
    } else if (dropped.stream != SPHC_STREAM_NONE) {
      out += std::string(dropped.stream == SPHC_STREAM_COLOR ? "-c" : "-d") +
             std::to_string(dropped.time_ns / kMillisecondNs) + " ";
    } else {
      EXPECT_EQ(status, SPHC_AGAIN);
      return out;
    }
  }
  ADD_FAILURE() << "the pairer never says that it has nothing more";
  return out;
}

TEST(Pairer, PairsInOrder) {
  Pairer pairer = makePairer();
  std::string out;
  for (int64_t t = 100; t < 400; t += 100) {
    EXPECT_EQ(pairer.push(color(t)), SPHC_OK);
    out += drain(&pairer);
    EXPECT_EQ(pairer.push(depth(t + 4)), SPHC_OK);
    out += drain(&pairer);
  }
  EXPECT_EQ(out, "c100+d104 c200+d204 c300+d304 ");
}

TEST(Pairer, DepthBeforeColorWaitsForABetterOne) {
  Pairer pairer = makePairer();
  pairer.push(depth(95));
  pairer.push(color(100));
  EXPECT_EQ(drain(&pairer), "");  // a depth at 101 might still come
  pairer.push(depth(101));
  EXPECT_EQ(drain(&pairer), "-d95 c100+d101 ");
}

// Pushes both streams in order of their times, as they come from devices; what comes out, and what is left at last.
std::string pairAll(Pairer *pairer, std::vector<int64_t> colors, std::vector<int64_t> depths) {
  std::string out;
  size_t c = 0, d = 0;
  while (c < colors.size() || d < depths.size()) {
    const bool is_color = d == depths.size() || (c < colors.size() && colors[c] <= depths[d]);
    sphc_capture next = is_color ? color(colors[c]) : depth(depths[d]);
    next.sequence = static_cast<uint32_t>(is_color ? ++c : ++d);
    EXPECT_EQ(pairer->push(next), SPHC_OK);
    out += drain(pairer);
  }
  pairer->flush();
  return out + "| " + drain(pairer);
}

TEST(Pairer, OfFasterColorTheNearestIsTaken) {
  Pairer pairer = makePairer();
  EXPECT_EQ(pairAll(&pairer, {0, 17, 33, 50, 67, 83, 100}, {0, 33, 67, 100}),
            "c0+d0 -c17 c33+d33 -c50 c67+d67 -c83 c100+d100 | ");
  EXPECT_EQ(pairer.counts().overtaken, 3u);
  EXPECT_EQ(pairer.counts().too_far, 0u);
}

TEST(Pairer, OfFasterColorBesideTheDepthTheNearestIsTaken) {
  Pairer pairer = makePairer();  // depth 4 ms after every third colour image
  EXPECT_EQ(pairAll(&pairer, {0, 11, 22, 33, 44, 55, 66}, {4, 37, 70}),
            "c0+d4 -c11 -c22 c33+d37 -c44 -c55 c66+d70 | ");
}

TEST(Pairer, OfFasterDepthTheNearestIsTaken) {
  Pairer pairer = makePairer();
  EXPECT_EQ(pairAll(&pairer, {10, 43, 77}, {0, 17, 33, 50, 67, 83}), "-d0 c10+d17 -d33 c43+d50 -d67 c77+d83 | ");
}

// Nothing better can come before the next image of the stream that was first, so nobody waits for that.
TEST(Pairer, AtOneRateAPairComesWithItsSecondImage) {
  for (const int64_t apart_ms : {5, -5}) {
    Pairer pairer = makePairer();
    for (int64_t i = 1; i <= 5; ++i) {
      const sphc_capture first = apart_ms > 0 ? color(100 * i) : depth(100 * i);
      const sphc_capture second = apart_ms > 0 ? depth(100 * i + apart_ms) : color(100 * i - apart_ms);
      pairer.push(first);
      const std::string before = drain(&pairer);
      pairer.push(second);
      const std::string after = drain(&pairer);
      if (i < 3) continue;  // the rates are not known yet
      EXPECT_EQ(before, "");
      EXPECT_NE(after.find("+"), std::string::npos) << apart_ms << " ms, " << i;
    }
    EXPECT_EQ(pairer.counts().pairs, 5u);
  }
}

// What was lost between two images is no slower rate.
TEST(Pairer, ALostImageIsNoGap) {
  Pairer pairer = makePairer();
  std::string out;
  const auto push = [&](sphc_capture next, uint32_t sequence) {
    next.sequence = sequence;
    EXPECT_EQ(pairer.push(next), SPHC_OK);
    out += drain(&pairer);
  };
  push(color(0), 1), push(depth(0), 1), push(color(17), 2), push(depth(33), 2);
  push(color(50), 4);  // 33 never came
  push(depth(67), 3);
  push(color(67), 5);
  EXPECT_EQ(out, "c0+d0 c17+d33 -c50 c67+d67 ");
}

TEST(Pairer, FlushEndsTheWaiting) {
  Pairer pairer = makePairer();
  pairer.push(depth(95));
  pairer.push(color(100));
  pairer.push(color(200));
  pairer.flush();
  EXPECT_EQ(drain(&pairer), "c100+d95 -c200 ");
}

TEST(Pairer, BeyondToleranceTheOlderIsDropped) {
  Pairer pairer = makePairer(4, 10);
  pairer.push(color(100));
  pairer.push(depth(150));
  EXPECT_EQ(drain(&pairer), "-c100 ");
  pairer.push(color(155));
  EXPECT_EQ(drain(&pairer), "");
  pairer.flush();
  EXPECT_EQ(drain(&pairer), "c155+d150 ");
  Pairer late = makePairer(4, 10);
  late.push(depth(100));
  late.push(color(150));
  late.flush();
  EXPECT_EQ(drain(&late), "-d100 -c150 ");
}

// The next colour image is nearer to the first depth image, and the second depth image nearer to that one.
TEST(Pairer, ANearerImageWithANearerOneOfItsOwnOvertakesNobody) {
  Pairer pairer = makePairer();
  for (const sphc_capture &next : {color(100), color(110), depth(106), depth(111)}) pairer.push(next);
  pairer.flush();
  EXPECT_EQ(drain(&pairer), "c100+d106 c110+d111 ");
}

TEST(Pairer, WhereNothingIsDroppedItSaysSo) {
  Pairer pairer = makePairer();
  Pair pair;
  sphc_capture dropped = color(1);
  EXPECT_EQ(pairer.pop(&pair.color, &pair.depth, &dropped), SPHC_AGAIN);
  EXPECT_EQ(dropped.stream, SPHC_STREAM_NONE);
}

TEST(Pairer, TimesFarApartAreNoPair) {
  Pairer pairer = makePairer(1, 10);
  sphc_capture early = color(0), late = depth(0);
  early.time_ns = std::numeric_limits<int64_t>::min();
  late.time_ns = std::numeric_limits<int64_t>::max();
  pairer.push(early);
  pairer.push(late);
  Pair pair;
  sphc_capture dropped = {};
  EXPECT_EQ(pairer.pop(&pair.color, &pair.depth, &dropped), SPHC_AGAIN);
  EXPECT_EQ(dropped.stream, SPHC_STREAM_COLOR);
}

TEST(Pairer, ExactlyTheToleranceIsAPair) {
  Pairer pairer = makePairer(4, 10);
  pairer.push(color(100));
  pairer.push(depth(110));
  EXPECT_EQ(drain(&pairer), "c100+d110 ");
}

TEST(Pairer, LoneStreamIsHandedBackWhenFull) {
  Pairer pairer = makePairer(2);
  EXPECT_EQ(pairer.push(color(1)), SPHC_OK);
  EXPECT_EQ(drain(&pairer), "");
  EXPECT_EQ(pairer.push(color(2)), SPHC_OK);
  EXPECT_EQ(pairer.push(color(3)), SPHC_E_CAPACITY);
  EXPECT_EQ(drain(&pairer), "-c1 ");
  EXPECT_EQ(pairer.push(color(3)), SPHC_OK);
}

// Pairs of two streams at 30 Hz, the depth images `late_ms` later at the host than those of colour.
size_t pairsOfLateDepth(uint32_t slots, int64_t late_ms) {
  Pairer pairer = makePairer(slots);
  std::string out;
  for (int64_t now = 0; now < 3000; ++now) {
    if (now % 33 == 0) pairer.push(color(now));
    out += drain(&pairer);
    if (now >= late_ms && (now - late_ms) % 33 == 0) pairer.push(depth(now - late_ms + 1));
    out += drain(&pairer);
  }
  return static_cast<size_t>(std::count(out.begin(), out.end(), '+'));
}

TEST(Pairer, ADelayTakesSlotsByItsRateAndOneMore) {  // docs/capture.md
  EXPECT_GT(pairsOfLateDepth(2, 0), 85u);
  EXPECT_LT(pairsOfLateDepth(4, 100), 5u);
  EXPECT_GT(pairsOfLateDepth(5, 100), 85u);
  EXPECT_LT(pairsOfLateDepth(5, 150), 5u);
  EXPECT_GT(pairsOfLateDepth(6, 150), 85u);
}

TEST(Pairer, OneSlotHoldsNothingBack) {
  Pairer pairer = makePairer(1);
  pairer.push(depth(99));
  EXPECT_EQ(drain(&pairer), "-d99 ");  // full, and nothing to pair with: the next push must find room
  pairer.push(color(100));
  EXPECT_EQ(drain(&pairer), "-c100 ");
}

TEST(Pairer, RefusesOlderCapturesAndUnknownStreams) {
  Pairer pairer = makePairer();
  EXPECT_EQ(pairer.push(color(100)), SPHC_OK);
  EXPECT_EQ(pairer.push(color(99)), SPHC_E_ARGUMENT);
  EXPECT_EQ(pairer.push(depth(50)), SPHC_OK);
  EXPECT_EQ(pairer.push(capture(SPHC_STREAM_NONE, 200)), SPHC_E_ARGUMENT);
  EXPECT_EQ(pairer.push(capture(7, 200)), SPHC_E_ARGUMENT);
}

TEST(Pairer, RefusesClocksAndTimePointsWithoutAName) {
  Pairer pairer = makePairer();
  for (const int32_t bad : {-1, 99}) {
    sphc_capture of_clock = color(100), of_point = color(100);
    of_clock.clock = bad;
    of_point.time_point = bad;
    EXPECT_EQ(pairer.push(of_clock), SPHC_E_ARGUMENT) << bad;
    EXPECT_EQ(pairer.push(of_point), SPHC_E_ARGUMENT) << bad;
  }
  EXPECT_EQ(pairer.push(color(100)), SPHC_OK) << "nothing was kept of them";
}

TEST(Pairer, KeepsTheLoansFieldsUnchanged) {
  Pairer pairer = makePairer();
  sphc_capture c = capture(SPHC_STREAM_COLOR, 100, 0xFEDCBA9876543210ull);
  c.sequence = 41;
  c.image.width = 640;
  pairer.push(c);
  pairer.push(depth(100));
  Pair pair;
  sphc_capture dropped = {};
  ASSERT_EQ(pairer.pop(&pair.color, &pair.depth, &dropped), SPHC_OK);
  EXPECT_EQ(pair.color.token, 0xFEDCBA9876543210ull);
  EXPECT_EQ(pair.color.sequence, 41u);
  EXPECT_EQ(pair.color.image.width, 640u);
}

// No loan is ever lost or given twice, pairs are in order and within tolerance, and nothing stalls.
TEST(Pairer, RandomStreamsGiveBackEveryLoanOnce) {
  Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    Pairer pairer = makePairer(1 + random.below(8), random.below(30));
    std::map<uint64_t, int> given[3];  // times that a token came back, for each stream
    int64_t time[3] = {}, last_pair = -1;
    uint64_t count[3] = {};
    const auto pop = [&] {
      for (;;) {
        Pair pair;
        sphc_capture dropped = {};
        if (pairer.pop(&pair.color, &pair.depth, &dropped) == SPHC_OK) {
          ++given[1][pair.color.token];
          ++given[2][pair.depth.token];
          EXPECT_GT(pair.color.time_ns, last_pair);
          last_pair = pair.color.time_ns;
        } else if (dropped.stream != SPHC_STREAM_NONE) {
          ++given[dropped.stream][dropped.token];
        } else {
          return;
        }
      }
    };
    for (int i = 0; i < 200; ++i) {
      const auto stream = static_cast<sphc_stream>(1 + random.below(2));
      time[stream] += 1 + random.below(40);
      sphc_capture c = capture(stream, time[stream]);
      c.token = count[stream]++;
      ASSERT_EQ(pairer.push(c), SPHC_OK);
      pop();
    }
    pairer.flush();
    pop();
    for (int stream = 1; stream < 3; ++stream) {
      for (uint64_t i = 0; i < count[stream]; ++i) ASSERT_EQ(given[stream][i], 1);
      ASSERT_EQ(given[stream].size(), count[stream]);
    }
  }
}

TEST(Pairer, PairsByTheMiddleOfTheExposure) {
  Pairer pairer = makePairer(4, 3);
  sphc_capture early = color(100), late = depth(110);
  early.time_point = SPHC_TIME_START;
  early.exposure_us = 10000;
  late.time_point = SPHC_TIME_END;
  late.exposure_us = 10000;
  pairer.push(early);
  pairer.push(late);
  EXPECT_EQ(drain(&pairer), "c100+d110 ");
  EXPECT_EQ(sphc_capture_middle_ns(&early), 105 * kMillisecondNs);
  EXPECT_EQ(sphc_capture_middle_ns(&late), 105 * kMillisecondNs);
  early.time_point = SPHC_TIME_ARRIVAL;
  EXPECT_EQ(sphc_capture_middle_ns(&early), 100 * kMillisecondNs);
  late.time_ns = std::numeric_limits<int64_t>::min();
  EXPECT_EQ(sphc_capture_middle_ns(&late), std::numeric_limits<int64_t>::min());
  EXPECT_EQ(sphc_capture_middle_ns(nullptr), 0);
}

TEST(Pairer, TimeGoesOnAfterAPairToo) {
  Pairer pairer = makePairer();
  pairer.push(color(100));
  pairer.push(depth(100));
  EXPECT_EQ(drain(&pairer), "c100+d100 ");
  EXPECT_EQ(pairer.push(color(99)), SPHC_E_ARGUMENT);
  EXPECT_EQ(pairer.push(color(100)), SPHC_OK);
}

TEST(Pairer, OneClockOnly) {
  Pairer pairer = makePairer();
  sphc_capture other = depth(100);
  other.clock = SPHC_CLOCK_BOOTTIME;
  EXPECT_EQ(pairer.push(color(100)), SPHC_OK);
  EXPECT_EQ(pairer.push(other), SPHC_E_ARGUMENT);
  EXPECT_EQ(pairer.push(depth(100)), SPHC_OK);
}

TEST(Pairer, CountsWhatItDropsAndWhatNeverCame) {
  Pairer pairer = makePairer(3, 5);
  const auto push = [&](sphc_capture c, uint32_t sequence) {
    c.sequence = sequence;
    EXPECT_EQ(pairer.push(c), SPHC_OK);
    drain(&pairer);
    return pairer.counts().last_drop;
  };
  push(color(100), 7);
  EXPECT_EQ(push(depth(101), 3), SPHC_DROP_NONE);
  push(color(200), 9);                                // one lost
  EXPECT_EQ(push(depth(290), 7), SPHC_DROP_TOO_FAR);  // three lost; colour 200 finds nobody
  push(depth(296), 8);
  EXPECT_EQ(push(color(301), 10), SPHC_DROP_OVERTAKEN);  // 290
  push(depth(302), 9);                                   // better than 296
  push(depth(400), 0);                                   // a source that started anew
  push(depth(410), 1);
  EXPECT_EQ(push(depth(420), 2), SPHC_DROP_FULL);  // no colour comes
  pairer.flush();
  drain(&pairer);
  const sphc_pairer_counts &counts = pairer.counts();
  EXPECT_EQ(counts.last_drop, SPHC_DROP_ENDED);
  EXPECT_EQ(counts.pairs, 2u);
  EXPECT_EQ(counts.too_far, 1u);
  EXPECT_EQ(counts.overtaken, 2u);
  EXPECT_EQ(counts.full, 1u);
  EXPECT_EQ(counts.ended, 2u);
  EXPECT_EQ(counts.color_lost, 1u);
  EXPECT_EQ(counts.depth_lost, 3u);
}

}  // namespace
}  // namespace sphc
