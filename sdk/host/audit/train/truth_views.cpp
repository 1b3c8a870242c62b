// truth_views RECORDING CALIBRATION FIRST LAST STEP X Y Z OUT: what is to be seen from (X, Y, Z), metres of the
// world. CALIBRATION - : the recording's own.  OUT, little-endian, for each view: 9 float64 camera_from_map by
// rows, then 128 x 128 float32 grey, then 128 x 128 bytes, 255 where that is known.
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "drivers/replay/replay.h"
#include "host/audit/score/look_around.h"
#include "host/audit/train/output.h"

namespace sphc::host {
namespace {

constexpr double kApartDeg = 20, kSeenShare = 0.5;

struct ReplayCloser {
  void operator()(sphc_replay *replay) const { sphc_replay_close(&replay); }
};
using Replay = std::unique_ptr<sphc_replay, ReplayCloser>;

Replay open(char **argv) {
  sphc_replay_config config;
  sphc_replay_config_init(&config, sizeof config);
  const auto number = [](const char *text) { return static_cast<uint32_t>(std::strtoul(text, nullptr, 10)); };
  config.first = number(argv[3]);
  config.last = number(argv[4]);
  config.step = number(argv[5]);
  sphc_replay *replay = nullptr;
  sphc_message why;
  const char *calibration = std::string(argv[2]) == "-" ? nullptr : argv[2];
  if (sphc_replay_open(argv[1], calibration, &config, &replay, &why) != SPHC_OK) throw std::runtime_error(why.text);
  return Replay(replay);
}

void write(const Matrix3 &camera_from_map, const TruthView &view, std::ostream *out) {
  for (int i = 0; i < 9; ++i) writeValue(camera_from_map(i / 3, i % 3), out);
  out->write(reinterpret_cast<const char *>(view.grey.data), static_cast<std::streamsize>(4 * view.grey.total()));
  out->write(reinterpret_cast<const char *>(view.seen.data), static_cast<std::streamsize>(view.seen.total()));
}

void run(char **argv) {
  const Replay replay = open(argv);
  const Vector3 centre(std::strtod(argv[6], nullptr), std::strtod(argv[7], nullptr), std::strtod(argv[8], nullptr));
  const Panorama panorama = lookAround(replay.get(), centre);
  std::ofstream out(argv[9], std::ios::binary);
  for (const Matrix3 &camera_from_map : choosePoses(replay.get(), panorama, kApartDeg, kSeenShare))
    write(camera_from_map, panorama.view(camera_from_map), &out);
  if (!out.flush()) throw std::runtime_error(std::string(argv[9]) + " cannot be written; is the disk full?");
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  if (argc != 10) {
    std::cerr << "usage: truth_views RECORDING CALIBRATION FIRST LAST STEP X Y Z OUT\n";
    return 2;
  }
  try {
    sphc::host::run(argv);
  } catch (const std::exception &failure) {
    std::cerr << "truth_views: " << failure.what() << '\n';
    return 1;
  }
  return 0;
}
