// Where a subcommand records to: one MCAP file, or a folder in the TUM layout.
#pragma once
#include <memory>
#include <string>

#include "host/recording/recorder.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::host {

struct Acceleration {
  double mps2[3];
};

// All throw std::runtime_error with cause and cure.
class RecordingOut {
 public:
  virtual ~RecordingOut() = default;
  virtual void add(const sphc_capture &capture) = 0;
  virtual void addPose(int64_t time_ns, const sphc_rigid &world_from_camera) = 0;
  // What an accelerometer felt, in the colour camera's axes.  One that keeps none takes none.
  virtual void addAcceleration(int64_t time_ns, const Acceleration &felt) = 0;
  virtual bool keepsAccelerations() const = 0;
  // Gives the recording its name.  Without it nothing is left of it.
  virtual void close() = 0;
};

// By the ending, small letters or large.
bool isMcap(const std::string &path);
bool isRaw(const std::string &path);

// `config` is that of a file.
std::unique_ptr<RecordingOut> createRecording(const std::string &path, const sphc_rig &calibration,
                                              const sphc_recorder_config &config);

// Nothing is dropped: adding waits for the disk.
sphc_recorder_config patientRecorderConfig();

}  // namespace sphc::host
