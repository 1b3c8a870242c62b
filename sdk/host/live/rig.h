// One camera that gives colour and depth, or two that give one each, as pairs of both.
//
// Two cameras may have two clocks; then both streams' times are brought to the host's CLOCK_MONOTONIC.  A camera
// that was unplugged is opened again as soon as it is back.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/live/device.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::host {

struct RigOptions {
  std::string both, color, depth;  // `both`, or the other two: lines of text for openDevice
  Wish wish;
  double tolerance_ms = 20;
  std::function<std::unique_ptr<Device>(const std::string &spec, const Wish &wish)> open = openDevice;
};

// How long a command waits for a pair before it looks whether it was interrupted, and shows what it has so far.
constexpr std::chrono::milliseconds kPairWait{200};

// Taken at about the same time; on loan.
struct CapturePair {
  sphc_capture color = {}, depth = {};
};

class Rig {
 public:
  enum class Got { kPair, kNothing, kEnd };
  using Tell = std::function<void(const std::string &)>;

  // Opens and starts the cameras.  `trouble` hears of what goes on by itself.
  Rig(const RigOptions &options, Tell trouble);
  ~Rig();
  Rig(const Rig &) = delete;
  Rig &operator=(const Rig &) = delete;

  // The next pair, within a timeout; to be released.
  Got next(std::chrono::milliseconds timeout, CapturePair *pair);
  void release(const CapturePair &pair);
  // When no more is asked for: what still waits for a partner is counted as a pair or as none.
  void endPairs() { emptyPairer(); }
  // How often a camera was lost: pairs from before a loss are void.
  uint32_t losses() const { return losses_; }

  // Sees every capture that comes, paired later or not, on the clock of the rig.
  void watch(std::function<void(const sphc_capture &)> watcher) { watcher_ = std::move(watcher); }
  // Hears in place of `trouble` of each capture that cannot be read: a broken camera has many.
  void hearUnreadable(Tell unreadable) { unreadable_ = std::move(unreadable); }

  std::vector<std::string> descriptions() const;
  std::string troubles() const;
  sphc_pairer_counts counts() const;
  bool calibration(sphc_rig *calibration) const;
  bool waits() const;
  // That is played in the place of one camera of both streams; null where it is cameras.
  recording::RecordingReader *replayed() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Camera {
    std::string spec;
    Wish wish;
    std::unique_ptr<Device> device;  // null while it is unplugged
    std::string why_not_back;        // as the last try to open it said
    bool ended = false;
    Clock::time_point retry;
    uint32_t failures = 0;  // in a row
    bool reopened = false;  // and has given nothing yet
    int64_t shift_ns = 0;   // of a clock that began again when the camera came back
    int64_t last_ns = 0, last_arrival_ns = 0;
    std::vector<uint64_t> mapper_memory;
    sphc_clock_mapper *mapper = nullptr;
  };

  void add(const std::string &spec, bool color, bool depth);
  void start(Camera *camera);
  void makePairer();
  void emptyPairer();
  bool pop(CapturePair *pair);
  // True where a capture came.
  bool acquireFrom(Camera *camera, std::chrono::microseconds timeout);
  void keepTimeGoing(Camera *camera, sphc_capture *capture);
  void bringToHostClock(Camera *camera, sphc_capture *capture);
  void lose(Camera *camera);
  void tryAgain(Camera *camera);
  void giveBack(const sphc_capture &capture);
  Camera &cameraOf(sphc_stream stream);

  RigOptions options_;
  Tell trouble_, unreadable_;
  std::function<void(const sphc_capture &)> watcher_;
  std::vector<Camera> cameras_;
  std::vector<uint64_t> pairer_memory_;
  sphc_pairer *pairer_ = nullptr;
  sphc_pairer_counts earlier_ = {};  // of pairers before a camera was unplugged
  bool flushed_ = false;
  uint32_t losses_ = 0;
};

}  // namespace sphc::host
