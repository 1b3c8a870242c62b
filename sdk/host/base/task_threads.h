// Threads for config.parallel: they wait for tasks, awake for a while after the last ones, then asleep.
#pragma once
#include <spherecloud/spherecloud.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace sphc::host {

class TaskThreads {
 public:
  // So many, with the one that calls run, or fewer where the system has no more.
  explicit TaskThreads(uint32_t threads) {
    helpers_.reserve(threads);
    try {
      for (uint32_t i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
    } catch (const std::system_error &) {  // those that run suffice
    }
  }
  ~TaskThreads() {
    begin(nullptr, nullptr, 0, true);
    for (std::thread &helper : helpers_) helper.join();
  }
  TaskThreads(const TaskThreads &) = delete;
  TaskThreads &operator=(const TaskThreads &) = delete;

  // config.parallel, with a TaskThreads as config.parallel_user.  Several threads may call it: who comes while the
  // helpers are busy does its tasks itself.
  static void run(void *user, uint32_t count, sphc_task_fn task, void *task_data) {
    auto &self = *static_cast<TaskThreads *>(user);
    const std::unique_lock<std::mutex> alone(self.busy_, std::try_to_lock);
    if (alone) {
      self.runAlone(count, task, task_data);
    } else {
      for (uint32_t i = 0; i < count; ++i) task(task_data, i);
    }
  }

 private:
  static constexpr int kAwake = 4000000;  // looks for new tasks before a helper sleeps: a millisecond or two

  void begin(sphc_task_fn task, void *task_data, uint32_t count, bool stop = false) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      task_ = task;
      task_data_ = task_data;
      count_ = count;
      next_ = 0;
      open_ = !stop;
      stop_ = stop;
      ++round_;
    }
    wake_.notify_all();
  }

  void runAlone(uint32_t count, sphc_task_fn task, void *task_data) {
    begin(task, task_data, count);
    work();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      open_ = false;
    }
    while (working_ != 0) std::this_thread::yield();
  }

  void work() {
    for (uint32_t i = next_++; i < count_; i = next_++) task_(task_data_, i);
  }

  void help() {
    for (uint32_t seen = 0;;) {
      for (int i = 0; i < kAwake && round_ == seen; ++i) continue;
      {
        std::unique_lock<std::mutex> lock(mutex_);
        wake_.wait(lock, [&] { return round_ != seen; });
        seen = round_;
        if (stop_) return;
        if (!open_) continue;
        ++working_;
      }
      work();
      --working_;
    }
  }

  std::mutex busy_, mutex_;
  std::condition_variable wake_;
  std::atomic<uint32_t> round_{0}, next_{0}, working_{0};
  sphc_task_fn task_ = nullptr;
  void *task_data_ = nullptr;
  uint32_t count_ = 0;
  bool open_ = false, stop_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace sphc::host
