#include <filesystem>

#include "drivers.h"
#include "drivers/openni2/openni2.h"
#include "openni2/oni_file.h"
#include "tests/support/openni2/virtual_tof.h"
#include "tests/support/temp_folder.h"

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
    vtof::plug(device_);
    taken_[device_] = false;
  }
  RunningCamera(const RunningCamera &) = delete;
  RunningCamera &operator=(const RunningCamera &) = delete;
  sphc_openni2 *get() { return camera_; }
  void unplug() { vtof::unplug(device_); }
  void stall() { vtof::run(device_, false); }

 private:
  static inline bool taken_[vtof::kDevices];
  int device_;
  sphc_openni2 *camera_ = nullptr;
};

// One recording a process, and a copy of it each time: OpenNI2 opens a file once.
class RecordingCopy {
 public:
  RecordingCopy() {
    static const test::TempFolder folder;
    static const std::string original = folder / "original.oni";
    if (!std::filesystem::exists(original)) writeOniFile(original, false);
    const std::string copy = folder_ / "copy.oni";
    std::filesystem::copy_file(original, copy);
    sphc_openni2_open(copy.c_str(), nullptr, &camera_, nullptr);
  }
  ~RecordingCopy() { sphc_openni2_close(&camera_); }
  RecordingCopy(const RecordingCopy &) = delete;
  RecordingCopy &operator=(const RecordingCopy &) = delete;
  sphc_openni2 *get() { return camera_; }

 private:
  test::TempFolder folder_;
  sphc_openni2 *camera_ = nullptr;
};

OpenedDriver openCamera() {
  const auto opened = std::make_shared<RunningCamera>();
  OpenedDriver driver{
      {}, opened, [camera = opened.get()] { camera->unplug(); }, [camera = opened.get()] { camera->stall(); }};
  if (sphc_openni2_source(opened->get(), &driver.source) != SPHC_OK) return {};
  return driver;
}

OpenedDriver openRecording() {
  const auto opened = std::make_shared<RecordingCopy>();
  OpenedDriver driver{{}, opened};
  if (sphc_openni2_source(opened->get(), &driver.source) != SPHC_OK) return {};
  return driver;
}

}  // namespace

// How many captures the recording has depends on when OpenNI2's recorder wakes; its end is tested elsewhere.
std::vector<Driver> driversUnderTest() {
  std::vector<Driver> drivers = {{"OpenNI2", openCamera}, {"OpenNI2Recording", openRecording}};
  drivers[1].may_end = true;
  return drivers;
}

}  // namespace sphc::contract
