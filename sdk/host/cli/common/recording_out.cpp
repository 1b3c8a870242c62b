#include "host/cli/common/recording_out.h"

#include <algorithm>
#include <cctype>

#include "host/base/checked_call.h"
#include "host/cli/common/new_recording.h"
#include "host/recording/writer_tum.h"

namespace sphc::host {
namespace {

class FileOut : public RecordingOut {
 public:
  FileOut(const std::string &path, const sphc_rig &calibration, const sphc_recorder_config &config)
      : recording_(path, NewRecording::IfCut::kRemove) {
    orThrow("cannot start the recording", [&](sphc_message *message) {
      return sphc_recorder_open(recording_.part().c_str(), &calibration, &config, &recorder_, message);
    });
    recording_.isMade();
  }
  ~FileOut() override { sphc_recorder_abandon(&recorder_); }

  void add(const sphc_capture &capture) override {
    notDropped(orThrow("cannot record an image",
                       [&](sphc_message *message) { return sphc_recorder_add(recorder_, &capture, message); }));
  }
  void addPose(int64_t time_ns, const sphc_rigid &world_from_camera) override {
    notDropped(orThrow("cannot record a pose", [&](sphc_message *message) {
      return sphc_recorder_add_pose(recorder_, time_ns, &world_from_camera, message);
    }));
  }
  void addAcceleration(int64_t time_ns, const Acceleration &felt) override {
    notDropped(orThrow("cannot record an acceleration", [&](sphc_message *message) {
      return sphc_recorder_add_acceleration(recorder_, time_ns, felt.mps2, message);
    }));
  }
  bool keepsAccelerations() const override { return true; }
  void close() override {
    orThrow("cannot end the recording",
            [&](sphc_message *message) { return sphc_recorder_close(&recorder_, message); });
    recording_.finish();
  }

 private:
  static void notDropped(sphc_status status) {
    if (status == SPHC_AGAIN)
      throw std::runtime_error("the disk took nothing for a minute; is it full, or failing?");
  }
  NewRecording recording_;
  sphc_recorder *recorder_ = nullptr;
};

class FolderOut : public RecordingOut {
 public:
  FolderOut(const std::string &path, const sphc_rig &calibration)
      : recording_(path, NewRecording::IfCut::kRemove), writer_(madeFolder(&recording_), calibration) {}

  void add(const sphc_capture &capture) override { writer_.add(capture.stream, capture.time_ns, capture.image); }
  void addPose(int64_t time_ns, const sphc_rigid &world_from_camera) override {
    writer_.addPose(time_ns, world_from_camera);
  }
  void addAcceleration(int64_t, const Acceleration &) override {}
  bool keepsAccelerations() const override { return false; }
  void close() override {
    writer_.finish();
    recording_.finish();
  }

 private:
  static const std::string &madeFolder(NewRecording *recording) {
    recording->makeFolder();
    return recording->part();
  }

  NewRecording recording_;
  recording::TumWriter writer_;
};

bool endsWith(const std::string &path, const std::string &ending) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == b; };
  return path.size() > ending.size() &&
         std::equal(path.end() - static_cast<std::ptrdiff_t>(ending.size()), path.end(), ending.begin(), same);
}

}  // namespace

bool isMcap(const std::string &path) { return endsWith(path, ".mcap"); }
bool isRaw(const std::string &path) { return endsWith(path, ".raw"); }

std::unique_ptr<RecordingOut> createRecording(const std::string &path, const sphc_rig &calibration,
                                              const sphc_recorder_config &config) {
  if (isMcap(path)) return std::make_unique<FileOut>(path, calibration, config);
  return std::make_unique<FolderOut>(path, calibration);
}

sphc_recorder_config patientRecorderConfig() {
  sphc_recorder_config config;
  orThrow("recorder", [&](sphc_message *) { return sphc_recorder_config_init(&config, sizeof config); });
  config.wait_us = 60000000;
  return config;
}

}  // namespace sphc::host
