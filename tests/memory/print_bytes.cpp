// Prints the bytes of every piece of memory for some configurations: configuration,memory,piece,bytes.
#include <cstdio>
#include <map>
#include <string>

#include "spherecloud/spherecloud_capture.h"
#include "tests/support/map_bytes.h"
#include "tests/support/scene.h"

namespace {

void runNothing(void *, uint32_t, sphc_task_fn, void *) {}

void printConfiguration(uint32_t width, uint32_t height, uint32_t keypoints, uint32_t tasks = 0) {
  sphc_localizer_config config;
  sphc_localizer_config_init(&config, sizeof config);
  config.rig.color_camera = sphc::test::pinhole(width, height, 0.8 * width);
  config.rig.depth_camera = sphc::test::pinhole(320, 288, 220);
  config.max_keypoints = keypoints;
  config.parallel = tasks ? runNothing : nullptr;
  config.parallel_tasks = tasks;
  const std::string name = std::to_string(width) + "x" + std::to_string(height) + "/" + std::to_string(keypoints) +
                           " keypoints" + (tasks ? "/" + std::to_string(tasks) + " tasks" : "");
  std::map<std::pair<uint32_t, std::string>, uint64_t> pieces;  // those of one name together
  sphc_memory_piece piece;
  for (uint32_t i = 0; sphc_localizer_memory_piece(&config, i, &piece) == SPHC_OK; ++i)
    pieces[{piece.scratch, piece.name}] += piece.bytes;
  sphc_memory need = {};
  sphc_localizer_memory(&config, &need, nullptr);
  if (tasks > 0) pieces.clear();  // the sums tell what they cost
  for (const auto &entry : pieces)
    std::printf("%s,%s,%s,%llu\n", name.c_str(), entry.first.first ? "scratch" : "state",
                entry.first.second.c_str(), static_cast<unsigned long long>(entry.second));
  std::printf("%s,state,all,%llu\n%s,scratch,all,%llu\n", name.c_str(),
              static_cast<unsigned long long>(need.state_bytes), name.c_str(),
              static_cast<unsigned long long>(need.scratch_bytes));
  if (tasks > 0) return;
  sphc_features_memory(&config, &need, nullptr);
  std::printf("%s,state,features of a frame,%llu\n", name.c_str(),
              static_cast<unsigned long long>(need.state_bytes));
}

}  // namespace

int main() {
  std::printf("configuration,memory,piece,bytes\n");
  for (uint32_t keypoints : {400u, 800u, 1600u}) printConfiguration(640, 480, keypoints);
  for (uint32_t tasks : {2u, 4u}) printConfiguration(640, 480, 800, tasks);
  printConfiguration(1280, 720, 800);

  const auto print = [](const char *what, const sphc_memory &need) {
    std::printf("%s,all,%llu\n", what, static_cast<unsigned long long>(need.state_bytes));
  };
  sphc_memory need = {};
  sphc_map_memory(&need);
  print("any,map view", need);
  sphc_pairer_memory(&need);
  print("any,pairer", need);
  sphc_clock_mapper_memory(&need);
  print("any,clock mapper", need);
  sphc_aligner_config aligner;
  sphc_aligner_config_init(&aligner, sizeof aligner);
  aligner.rig.color_camera = aligner.rig.depth_camera = sphc::test::pinhole(640, 480, 500);
  sphc_aligner_memory(&aligner, &need, nullptr);
  print("640x480 from 640x480,aligner", need);
  aligner.rig.depth_camera = sphc::test::pinhole(320, 288, 220);
  sphc_aligner_memory(&aligner, &need, nullptr);
  print("640x480 from 320x288,aligner", need);
  const size_t of_64 = sphc::test::randomMap(64, 1).size(), of_1088 = sphc::test::randomMap(1088, 1).size();
  std::printf("any,map file,each point,%zu\n", (of_1088 - of_64) / 1024);
  std::printf("any,map file,header,%zu\n", of_64 - 64 * ((of_1088 - of_64) / 1024));
  return 0;
}
