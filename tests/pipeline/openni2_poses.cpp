// openni2_poses RECORDING MAP - localizes a recording twice, through the replay driver and through OpenNI2's own
// runtime with a virtual camera that shows the recording; the results must be the same to the last bit.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "drivers/openni2/openni2.h"
#include "drivers/replay/replay.h"
#include "spherecloud/spherecloud.hpp"
#include "tests/support/openni2/virtual_tof.h"

namespace {

namespace vtof = sphc::vtof;
constexpr uint32_t kPatienceUs = 10000000;

void require(sphc_status status, const char *what, const char *why) {
  if (status >= 0) return;
  std::fprintf(stderr, "%s: %s (%s)\n", what, why, sphc_status_name(status));
  std::exit(1);
}

void *allocate(size_t bytes, size_t alignment) {
  return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);  // until the process ends
}

std::vector<uint64_t> readMap(const char *path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<uint64_t> words((bytes.size() + 7) / 8);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

sphc_localizer_config configOf(const sphc_replay *replay) {
  sphc_localizer_config config;
  sphc_localizer_config_init(&config, sizeof config);
  sphc_replay_rig(replay, &config.rig);
  return config;
}

// Pairs captures and localizes the pairs.
class Pipeline {
 public:
  Pipeline(const sphc_localizer_config &config, const std::vector<uint64_t> &map_file, const sphc_source &source)
      : source_(source) {
    sphc_message message = {};
    sphc_memory need = {};
    sphc_map_memory(&need);
    require(sphc_map_init(allocate(need.state_bytes, need.alignment), need.state_bytes, map_file.data(),
                          map_file.size() * 8, &map_, &message),
            "map", message.text);
    require(sphc_localizer_memory(&config, &need, &message), "localizer", message.text);
    require(sphc_localizer_init(allocate(need.state_bytes, need.alignment), need.state_bytes,
                                allocate(need.scratch_bytes, need.alignment), need.scratch_bytes, &config,
                                &localizer_, &message),
            "localizer", message.text);
    require(sphc_localizer_set_map(localizer_, 0, map_), "map", sphc_localizer_message(localizer_));
    sphc_pairer_config pairing;
    sphc_pairer_config_init(&pairing, sizeof pairing);
    sphc_pairer_memory(&need);
    require(sphc_pairer_init(allocate(need.state_bytes, need.alignment), need.state_bytes, &pairing, &pairer_,
                             &message),
            "pairer", message.text);
  }

  // Takes one capture from the source; false at its end.
  bool step() {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = source_.acquire(source_.self, kPatienceUs, &capture);
    require(status, "acquire", source_.message(source_.self));
    if (status != SPHC_OK) return false;
    require(sphc_pairer_push(pairer_, &capture), "pairer", "full");
    sphc_capture color = {}, depth = {}, dropped = {};
    for (;;) {
      if (sphc_pairer_pop(pairer_, &color, &depth, &dropped) == SPHC_OK)
        localize(color, depth);
      else if (dropped.stream == SPHC_STREAM_NONE)
        return true;
      else
        source_.release(source_.self, &dropped);
    }
  }

  const std::vector<sphc_localizer_result> &results() const { return results_; }

 private:
  void localize(const sphc_capture &color, const sphc_capture &depth) {
    const sphc_localizer_frame frame =
        spherecloud::frame(color.sequence, color.time_ns, color.image, depth.time_ns, depth.image);
    sphc_localizer_result result;
    std::memset(&result, 0, sizeof result);
    result.struct_size = sizeof result;
    require(sphc_localizer_process(localizer_, &frame, &result), "localizer", sphc_localizer_message(localizer_));
    results_.push_back(result);
    source_.release(source_.self, &color);
    source_.release(source_.self, &depth);
  }

  sphc_source source_;
  sphc_map *map_ = nullptr;
  sphc_localizer *localizer_ = nullptr;
  sphc_pairer *pairer_ = nullptr;
  std::vector<sphc_localizer_result> results_;
};

void show(const sphc_capture &capture) {
  vtof::Frame frame = {};
  frame.sensor = capture.stream == SPHC_STREAM_COLOR ? ONI_SENSOR_COLOR : ONI_SENSOR_DEPTH;
  frame.index = static_cast<int>(capture.sequence);
  frame.timestamp_us = static_cast<uint64_t>(capture.time_ns / 1000);
  frame.pixels = capture.image.data;
  if (capture.time_ns % 1000 != 0 || !vtof::emit(0, frame)) {
    std::fprintf(stderr, "capture %u of the recording cannot be shown\n", capture.sequence);
    std::exit(1);
  }
}

// The recording shown to the camera, two captures at a time.
void showAll(const sphc_source &recording, Pipeline *camera) {
  require(recording.start(recording.self), "recording", recording.message(recording.self));
  for (int shown = 1;; ++shown) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = recording.acquire(recording.self, kPatienceUs, &capture);
    require(status, "recording", recording.message(recording.self));
    if (status != SPHC_OK) break;
    show(capture);
    recording.release(recording.self, &capture);
    if (shown % 2 == 0) camera->step(), camera->step();
  }
  recording.stop(recording.self);
}

sphc_openni2 *openCamera(const sphc_localizer_config &config) {
  sphc_openni2_config wanted;
  sphc_openni2_config_init(&wanted, sizeof wanted);
  wanted.color = {config.rig.color_camera.width, config.rig.color_camera.height, 0};
  wanted.depth = {config.rig.depth_camera.width, config.rig.depth_camera.height, 0};
  wanted.stall_us = 60000000;
  sphc_openni2 *camera = nullptr;
  sphc_message message = {};
  require(sphc_openni2_open(vtof::uri(0), &wanted, &camera, &message), "camera", message.text);
  return camera;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) return 2;
  sphc_replay_config replaying;
  sphc_replay_config_init(&replaying, sizeof replaying);
  replaying.color_format = SPHC_FORMAT_RGB8;
  sphc_replay *replay = nullptr;
  sphc_message message = {};
  require(sphc_replay_open(argv[1], nullptr, &replaying, &replay, &message), "recording", message.text);
  const sphc_localizer_config config = configOf(replay);
  const std::vector<uint64_t> map_file = readMap(argv[2]);

  sphc_source recording = {}, live = {};
  sphc_replay_source(replay, &recording);
  Pipeline replayed(config, map_file, recording);
  require(recording.start(recording.self), "recording", recording.message(recording.self));
  while (replayed.step()) continue;
  recording.stop(recording.self);

  sphc_openni2 *camera = openCamera(config);
  sphc_openni2_source(camera, &live);
  Pipeline captured(config, map_file, live);
  require(live.start(live.self), "camera", live.message(live.self));
  showAll(recording, &captured);
  sphc_openni2_close(&camera);
  sphc_replay_close(&replay);

  size_t same = 0, localized = 0;
  for (size_t i = 0; i < replayed.results().size() && i < captured.results().size(); ++i) {
    same += std::memcmp(&replayed.results()[i], &captured.results()[i], sizeof(sphc_localizer_result)) == 0;
    localized += replayed.results()[i].outcome == SPHC_OUTCOME_LOCALIZED;
  }
  std::printf("replayed %zu frames, localized %zu; through OpenNI2 %zu frames, %zu the same to the bit\n",
              replayed.results().size(), localized, captured.results().size(), same);
  const bool enough = localized > 0 && 2 * localized > replayed.results().size();
  return enough && same == replayed.results().size() && same == captured.results().size() ? 0 : 1;
}
