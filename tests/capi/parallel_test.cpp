// config.parallel: a frame by several threads gives the bytes of one.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "host/base/task_threads.h"
#include "tests/capi/answers.h"
#include "tests/capi/bytes.h"

namespace {

using sphc::host::TaskThreads;
using sphc::test::Answer;
using sphc::test::answerOf;
using sphc::test::SceneFrame;
using sphc::test::Session;

constexpr uint32_t kFrames = 5;

// One thread, and the last task first.
void runBackwards(void *calls, uint32_t count, sphc_task_fn task, void *task_data) {
  ++*static_cast<uint32_t *>(calls);
  for (uint32_t i = count; i > 0; --i) task(task_data, i - 1);
}

// Each task on a thread of its own, all at the same time.
void runOnThreads(void *, uint32_t count, sphc_task_fn task, void *task_data) {
  std::vector<std::thread> threads;
  for (uint32_t i = 0; i < count; ++i) threads.emplace_back(task, task_data, i);
  for (std::thread &thread : threads) thread.join();
}

// Goes on by a microsecond whenever one of the threads reads it.
struct SharedClock {
  std::atomic<int64_t> reads{0};
  static int64_t read(void *user) { return 1000 * ++static_cast<SharedClock *>(user)->reads; }
};

void expectSame(const Answer &a, const Answer &b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(std::memcmp(&a.result, &b.result, sizeof a.result), 0);
  ASSERT_EQ(a.observations.size(), b.observations.size());
  EXPECT_EQ(std::memcmp(a.observations.data(), b.observations.data(),
                        a.observations.size() * sizeof(sphc_localizer_observation)),
            0);
}

class ParallelFrames : public testing::Test {
 protected:
  ParallelFrames() {
    for (uint32_t i = 0; i < kFrames; ++i) {
      frames_.push_back(sphc::test::sceneFrame(config_, i % 4, i == 3));  // one of another room
      frames_[i]->frame.color_time_ns = frames_[i]->frame.depth_time_ns = (i + 1) * int64_t{50000000};
    }
  }
  sphc_localizer_config inTasks(uint32_t tasks, sphc_parallel_fn run, void *user) const {
    sphc_localizer_config config = config_;
    config.parallel = run;
    config.parallel_user = user;
    config.parallel_tasks = tasks;
    return config;
  }
  std::vector<Answer> answers(const sphc_localizer_config &config, double probes) const {
    Session session(config, 0.5, 2);
    session.setParameter(SPHC_PARAMETER_PROBES, probes);
    std::vector<Answer> all;
    for (const auto &each : frames_)
      all.push_back(answerOf(&session, [&](sphc_localizer *localizer, sphc_localizer_result *result) {
        return sphc_localizer_process(localizer, &each->frame, result);
      }));
    return all;
  }

  sphc_localizer_config config_ = sphc::test::sceneConfig();
  std::vector<std::unique_ptr<SceneFrame>> frames_;
};

TEST_F(ParallelFrames, SameBytes) {
  TaskThreads pool(3);
  for (const sphc_localizer_mode mode : {SPHC_MODE_TRACKING, SPHC_MODE_SINGLE})
    for (const double probes : {8.0, 0.0}) {
      config_.mode = mode;
      const std::vector<Answer> alone = answers(config_, probes);
      EXPECT_EQ(alone[0].status, SPHC_OK);
      for (const uint32_t tasks : {1u, 2u, 3u, 8u}) {
        uint32_t calls = 0;
        const std::vector<Answer> by_others[] = {answers(inTasks(tasks, runOnThreads, nullptr), probes),
                                                 answers(inTasks(tasks, TaskThreads::run, &pool), probes),
                                                 answers(inTasks(tasks, runBackwards, &calls), probes)};
        for (const std::vector<Answer> &others : by_others)
          for (uint32_t i = 0; i < kFrames; ++i) expectSame(others[i], alone[i]);
        EXPECT_TRUE(tasks == 1 ? calls == 0 : calls >= 3 * kFrames) << calls;
      }
    }
}

// Both halves call the function at the same time.
TEST_F(ParallelFrames, SameBytesInTwoHalves) {
  const std::vector<Answer> alone = answers(config_, 8);
  TaskThreads threads(2);
  const sphc_localizer_config config = inTasks(2, TaskThreads::run, &threads);
  Session session(config, 0.5, 2);
  spherecloud::Features of[2];
  for (spherecloud::Features &features : of) ASSERT_TRUE(spherecloud::Features::make(config, &features).ok());
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frames_[0]->frame, of[0].get()), SPHC_OK);
  for (uint32_t i = 0; i < kFrames; ++i) {
    sphc_status next = SPHC_OK;
    std::thread extracting([&] {
      if (i + 1 < kFrames)
        next = sphc_localizer_extract(session.localizer(), &frames_[i + 1]->frame, of[(i + 1) % 2].get());
    });
    const Answer answer = answerOf(&session, [&](sphc_localizer *localizer, sphc_localizer_result *result) {
      return sphc_localizer_locate(localizer, &frames_[i]->frame, of[i % 2].get(), result);
    });
    extracting.join();
    EXPECT_EQ(next, SPHC_OK);
    expectSame(answer, alone[i]);
  }
}

// The clock is read by all of the threads.
TEST_F(ParallelFrames, EndAtTheirDeadline) {
  constexpr uint32_t kTasks = 3, kLastReads = 20;  // of each task, once time is over
  constexpr int64_t kMostReads = 10000;
  TaskThreads threads(kTasks);
  SharedClock clock;
  sphc_localizer_config config = inTasks(kTasks, TaskThreads::run, &threads);
  config.clock = SharedClock::read;
  config.clock_user = &clock;
  Session session(config, 0.5, 2);
  for (const uint32_t deadline_us : {1u, 30u, 100u, 200u, 20000000u})
    for (const auto &each : frames_) {
      sphc_localizer_frame frame = each->frame;
      frame.deadline_us = deadline_us;
      sphc_localizer_result result = spherecloud::emptyResult();
      const int64_t before = clock.reads;
      EXPECT_GE(sphc_localizer_process(session.localizer(), &frame, &result), SPHC_OK);
      const int64_t reads = clock.reads - before;
      if (deadline_us > kMostReads) {
        EXPECT_EQ(result.cuts, 0u);
        EXPECT_LT(reads, kMostReads);
        EXPECT_GT(reads, 400);  // else the deadlines before were none
        continue;
      }
      EXPECT_LE(reads, deadline_us + kLastReads * kTasks) << deadline_us;
      EXPECT_NE(result.cuts, 0u) << deadline_us;
      if (deadline_us == 1) {
        EXPECT_EQ(result.outcome, SPHC_OUTCOME_DEADLINE);
      }
    }
}

TEST(ParallelMemory, TasksNeedSomeAndBoundsHold) {
  sphc_localizer_config config = sphc::test::sceneConfig();
  uint32_t calls = 0;
  for (const uint32_t width : {16u, 320u, 1280u, 8192u})
    for (const uint32_t height : {16u, 240u, 960u, 8192u})
      for (const uint32_t keypoints : {64u, 800u, 4096u}) {
        config.rig.color_camera = sphc::test::pinhole(width, height, 500);
        config.max_keypoints = keypoints;
        config.parallel = nullptr;
        config.parallel_tasks = 0;
        sphc_memory alone = {};
        ASSERT_EQ(sphc_localizer_memory(&config, &alone, nullptr), SPHC_OK);
        config.parallel = runBackwards;
        config.parallel_user = &calls;
        for (uint32_t tasks = 1; tasks <= SPHC_PARALLEL_MAX; ++tasks) {
          config.parallel_tasks = tasks;
          sphc_memory need = {};
          ASSERT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
          ASSERT_LE(need.state_bytes, SPHC_LOCALIZER_STATE_BYTES_MAX(keypoints, config.max_maps));
          ASSERT_LE(need.scratch_bytes - alone.scratch_bytes,
                    SPHC_LOCALIZER_PARALLEL_BYTES_MAX(keypoints, width, tasks));
          if (tasks == 1) {
            EXPECT_EQ(need.scratch_bytes, alone.scratch_bytes);
            EXPECT_EQ(need.state_bytes, alone.state_bytes);
          } else {
            EXPECT_GT(need.scratch_bytes, alone.scratch_bytes);
          }
        }
      }
  EXPECT_EQ(calls, 0u);
}

}  // namespace
