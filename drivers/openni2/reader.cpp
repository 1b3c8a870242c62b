#include "reader.h"

#include <pthread.h>

#include <cstring>
#include <mutex>
#include <new>

#include "explain.h"
#include "wakeup.h"

namespace sphc::openni2 {

namespace {

using Lock = std::lock_guard<Wakeup>;

}  // namespace

// Never deleted: its thread runs until the process ends.
struct Reader {
  static Reader &theOne() {
    alignas(Reader) static unsigned char memory[sizeof(Reader)];
    static Reader &reader = *new (memory) Reader;
    return reader;
  }

  void queue(ReaderJob *job) {
    if (job->is_queued_) return;
    job->is_queued_ = true;
    job->next_ = nullptr;
    *end_ = job;
    end_ = &job->next_;
    wakeup_.wake();
  }
  void leaveQueue(ReaderJob *job) {
    ReaderJob **link = &first_;
    while (*link && *link != job) link = &(*link)->next_;
    if (!*link) return;
    *link = job->next_;
    if (end_ == &job->next_) end_ = link;
    job->is_queued_ = false;
  }
  void waitFor(const ReaderJob &job) {
    while (job.is_queued_ || current_ == &job) wakeup_.wait();
  }
  [[noreturn]] void run() {
    wakeup_.lock();
    for (;;) {
      while (!first_) wakeup_.wait();
      current_ = first_;
      leaveQueue(current_);
      wakeup_.unlock();
      current_->read();
      wakeup_.lock();
      current_ = nullptr;
      wakeup_.wake();
    }
  }

  Wakeup wakeup_;  // for all that follows
  ReaderJob *first_ = nullptr, **end_ = &first_, *current_ = nullptr;
  bool is_running_ = false;
};

sphc_status ReaderJob::startReader(sphc_message *message) {
  Reader &reader = Reader::theOne();
  const Lock lock(reader.wakeup_);
  if (reader.is_running_) return SPHC_OK;
  pthread_t thread;
  const auto run = [](void *self) -> void * { static_cast<Reader *>(self)->run(); };
  const int error = pthread_create(&thread, nullptr, run, &reader);
  if (error != 0)
    return explain(message, SPHC_E_DEVICE, "no thread can be made (%s); end some of this user's",
                   std::strerror(error));
  pthread_detach(thread);
  reader.is_running_ = true;
  return SPHC_OK;
}

void ReaderJob::ask() {
  Reader &reader = Reader::theOne();
  const Lock lock(reader.wakeup_);
  reader.queue(this);
}

void ReaderJob::askAndWait() {
  Reader &reader = Reader::theOne();
  const Lock lock(reader.wakeup_);
  reader.queue(this);
  reader.waitFor(*this);
}

void ReaderJob::withdraw() {
  Reader &reader = Reader::theOne();
  const Lock lock(reader.wakeup_);
  reader.leaveQueue(this);
  reader.waitFor(*this);
}

}  // namespace sphc::openni2
