// One device of OpenNI2 with its streams, opened as a config asks for it, or not at all.
#pragma once

#include "library.h"
#include "openni2.h"
#include "player.h"
#include "streams.h"

namespace sphc::openni2 {

class Device {
 public:
  Device() = default;
  ~Device() { close(); }
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;

  sphc_status open(const char *uri, const sphc_openni2_config &config, sphc_message *message);
  // Leaves the streams' threads ended.
  void close();

  sphc_status start(sphc_message *message);
  void stop();
  // Of a recording, whose frames come as they are asked for.
  Player &player() { return player_; }

  bool isRecording() const { return is_recording_; }
  bool has(int stream) const { return streams_[stream] != nullptr; }
  OniStreamHandle stream(int stream) const { return streams_[stream]; }
  // All that it has, and which they are; how many.
  int listStreams(OniStreamHandle (&handles)[kStreams], int (&streams)[kStreams]) const;
  const OniVideoMode &mode(int stream) const { return modes_[stream]; }
  size_t frameBytes(int stream) const;
  void describe(sphc_openni2_info *info) const;

  sphc_status setControl(sphc_openni2_control control, int32_t value, sphc_message *message);
  sphc_status getControl(sphc_openni2_control control, int32_t *value, sphc_message *message) const;

 private:
  sphc_status openStream(int stream, const sphc_openni2_mode &wanted, sphc_message *message);
  sphc_status setMode(int stream, const sphc_openni2_mode &wanted, sphc_message *message);
  sphc_status makePlain(int stream, sphc_message *message);
  sphc_status setRegistration(bool on, sphc_message *message);
  sphc_status checkFrameSync(sphc_message *message) const;
  sphc_status playByHand(sphc_message *message);
  bool startPlayer();
  sphc_camera cameraHint(int stream) const;

  OniDeviceHandle device_ = nullptr;
  OniStreamHandle streams_[kStreams] = {};
  OniVideoMode modes_[kStreams] = {};
  Player player_;
  bool is_recording_ = false, player_awake_ = false, registration_ = false, frame_sync_ = false;
};

}  // namespace sphc::openni2
