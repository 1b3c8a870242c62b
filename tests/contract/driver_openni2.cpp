#include "drivers.h"
#include "drivers/openni2/openni2.h"
#include "tests/support/openni2/virtual_tof.h"

namespace sphc::contract {

namespace {

// A virtual camera that runs freely, in a process that has two.
class RunningCamera {
 public:
  RunningCamera() : device_(taken_[0] ? 1 : 0) {
    taken_[device_] = true;
    sphc_openni2_open(vtof::uri(device_), nullptr, &camera_, nullptr);
    vtof::run(device_, true);
  }
  ~RunningCamera() {
    sphc_openni2_close(&camera_);
    vtof::run(device_, false);
    taken_[device_] = false;
  }
  RunningCamera(const RunningCamera &) = delete;
  RunningCamera &operator=(const RunningCamera &) = delete;
  sphc_openni2 *get() { return camera_; }

 private:
  static inline bool taken_[vtof::kDevices];
  int device_;
  sphc_openni2 *camera_ = nullptr;
};

OpenedDriver openCamera() {
  const auto opened = std::make_shared<RunningCamera>();
  OpenedDriver driver{{}, opened};
  if (sphc_openni2_source(opened->get(), &driver.source) != SPHC_OK) return {};
  return driver;
}

}  // namespace

std::vector<Driver> driversUnderTest() { return {{"OpenNI2", openCamera}}; }

}  // namespace sphc::contract
