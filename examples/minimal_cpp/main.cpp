// minimal_cpp - a map, a recording, a pose a frame, through spherecloud.hpp.
//
//     minimal_cpp MAP.sphc RECORDING
#define SPHC_UNSTABLE 1  // the replay driver is
#include <drivers/replay/replay.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <spherecloud/spherecloud.hpp>
#include <stdexcept>
#include <string>

namespace {

struct CloseReplay {
  void operator()(sphc_replay *replay) const { sphc_replay_close(&replay); }
};
using Replay = std::unique_ptr<sphc_replay, CloseReplay>;

Replay openReplay(const char *folder) {
  sphc_replay *replay = nullptr;
  spherecloud::Status status;
  status.set(sphc_replay_open(folder, nullptr, nullptr, &replay, status.message())).orThrow();
  return Replay(replay);
}

// What refuses a map does not know its path.
spherecloud::Map openMap(const char *path, spherecloud::AlignedBuffer *file) {
  spherecloud::Map map;
  spherecloud::Status status = spherecloud::readFile(path, file);
  if (status.ok()) status = spherecloud::Map::open(file->data(), file->size(), &map);
  if (!status.ok()) throw std::runtime_error(std::string(path) + ": " + status.text());
  return map;
}

sphc_localizer_config configFor(const sphc_replay *replay) {
  sphc_localizer_config config = spherecloud::defaultConfig();
  spherecloud::Status(sphc_replay_rig(replay, &config.rig)).orThrow();
  return config;
}

void localizeAll(const char *map_path, const char *folder) {
  spherecloud::checkAbi().orThrow();
  const Replay replay = openReplay(folder);
  spherecloud::AlignedBuffer file;
  const spherecloud::Map map = openMap(map_path, &file);
  spherecloud::Localizer localizer;
  spherecloud::Localizer::make(configFor(replay.get()), map, &localizer).orThrow();

  sphc_localizer_result result = spherecloud::emptyResult();
  for (uint32_t i = 0; i < sphc_replay_frame_count(replay.get()); ++i) {
    sphc_localizer_frame frame = {};
    spherecloud::Status read;
    read.set(sphc_replay_read_frame(replay.get(), i, &frame, read.message())).orThrow();
    if (localizer.process(frame, &result).orThrow().ok()) {
      const sphc_rigid pose = spherecloud::inverse(result.camera_from_map);  // map_from_camera
      std::printf("%u at %.3f %.3f %.3f, q_wxyz %.4f %.4f %.4f %.4f\n", frame.sequence, pose.t_m[0], pose.t_m[1],
                  pose.t_m[2], pose.q_wxyz[0], pose.q_wxyz[1], pose.q_wxyz[2], pose.q_wxyz[3]);
    } else {
      std::printf("%u not localized: %s\n", frame.sequence, sphc_localizer_outcome_name(result.outcome));
    }
  }
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MAP.sphc RECORDING\n", argv[0]);
    return 2;
  }
  try {
    localizeAll(argv[1], argv[2]);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
