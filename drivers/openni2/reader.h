// The one thread that asks OpenNI2 for frames, from the first device that is opened to the end of the process.
//
// OpenNI2 remembers every thread that ever asked, and asks each whether it lives when another one comes: that is
// undefined once a thread has ended, and hangs now and then.  So no thread that ends asks it.
#pragma once
#include "openni2.h"

namespace sphc::openni2 {

// Done by the reader, one at a time.  Its memory is the caller's: it is withdrawn, or was done, before that goes.
class ReaderJob {
 public:
  ReaderJob(const ReaderJob &) = delete;
  ReaderJob &operator=(const ReaderJob &) = delete;

  // Starts the reader where it does not run yet.
  static sphc_status startReader(sphc_message *message);

  // From any thread: soon.  Asked for again before it begins, it is done once.
  void ask();
  // Returns when it is done.
  void askAndWait();
  // From here it is not done.  Nobody asks for it any more.
  void withdraw();

 protected:
  ReaderJob() = default;
  virtual ~ReaderJob() = default;
  virtual void read() = 0;

 private:
  friend struct Reader;
  ReaderJob *next_ = nullptr;
  bool is_queued_ = false;
};

// Calls a function of the caller on the reader's thread, and waits for it.
template <typename Function>
void onReader(const Function &function) {
  struct Call final : ReaderJob {
    explicit Call(const Function &called) : function(called) {}
    void read() override { function(); }
    const Function &function;
  };
  Call(function).askAndWait();
}

}  // namespace sphc::openni2
