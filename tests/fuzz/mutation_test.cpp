// A bounded, deterministic walk around every target's seeds: for the ordinary run, under any sanitizer.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "runtime/base/random.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

void mutate(std::vector<uint8_t> *bytes, Random *random) {
  const uint32_t changes = 1 + random->below(6);
  for (uint32_t i = 0; i < changes; ++i) {
    if (bytes->empty()) bytes->push_back(0);
    const uint32_t size = static_cast<uint32_t>(bytes->size());
    // half of them near the front, where structure is
    const uint32_t at = random->below(2) ? random->below(size) : random->below(std::min(size, 160u));
    const auto place = bytes->begin() + at;
    switch (random->below(6)) {
      case 0:
        *place = static_cast<uint8_t>(*place ^ (1u << random->below(8)));
        break;
      case 1:
        *place = static_cast<uint8_t>(random->below(256));
        break;
      case 2:
        *place = random->below(2) ? uint8_t{255} : uint8_t{0};
        break;
      case 3:
        bytes->erase(place, place + std::min(random->below(40), size - at));
        break;
      case 4:
        bytes->insert(place, 1 + random->below(8), static_cast<uint8_t>(random->below(256)));
        break;
      default: {  // a piece of it to another place
        const std::vector<uint8_t> piece(place, place + std::min(random->below(24), size - at));
        bytes->insert(bytes->begin() + random->below(size), piece.begin(), piece.end());
      }
    }
  }
}

// What fuzzing found to add coverage: each input behind its length, four bytes, low ones first.
std::vector<std::vector<uint8_t>> keptInputs(const std::string &name) {
  std::ifstream file(std::string(SPHC_FUZZ_CORPORA) + "/" + name + ".inputs", std::ios::binary);
  std::vector<std::vector<uint8_t>> inputs;
  uint8_t length[4];
  while (file.read(reinterpret_cast<char *>(length), sizeof length)) {
    std::vector<uint8_t> input(length[0] | length[1] << 8 | length[2] << 16 | size_t{length[3]} << 24);
    file.read(reinterpret_cast<char *>(input.data()), static_cast<std::streamsize>(input.size()));
    if (!file) ADD_FAILURE() << name << ".inputs is cut off; write it anew with fuzz.py --keep";
    inputs.push_back(std::move(input));
  }
  return inputs;
}

void walk(const char *name, int runs) {
  for (const Target &target : allTargets()) {
    if (std::string(target.name) != name) continue;
    const std::vector<std::vector<uint8_t>> kept = keptInputs(name);
    EXPECT_FALSE(kept.empty()) << "fuzz.py --keep writes them";
    for (const std::vector<uint8_t> &input : kept) target.run(input.data(), input.size());
    Random random(2024);
    for (const std::vector<uint8_t> &seed : target.seeds) target.run(seed.data(), seed.size());
    for (int i = 0; i < runs; ++i) {
      std::vector<uint8_t> bytes = target.seeds[random.below(static_cast<uint32_t>(target.seeds.size()))];
      mutate(&bytes, &random);
      target.run(bytes.data(), bytes.size());
    }
    return;
  }
  ADD_FAILURE() << "there is no target " << name;
}

TEST(Mutations, Map) { walk("map", 20000); }
TEST(Mutations, MapRead) { walk("mapRead", 2000); }
TEST(Mutations, Encryption) { walk("encryption", 5000); }
TEST(Mutations, Signature) { walk("signature", 500); }
TEST(Mutations, Config) { walk("config", 1500); }
TEST(Mutations, Frame) { walk("frame", 600); }
TEST(Mutations, Session) { walk("session", 1000); }
TEST(Mutations, Align) { walk("align", 3000); }
TEST(Mutations, Pairer) { walk("pairer", 20000); }
TEST(Mutations, ClockMapper) { walk("clockMapper", 10000); }
#ifdef SPHC_FUZZ_RECORDINGS
TEST(Mutations, Recording) { walk("recording", 3000); }
TEST(Mutations, RawRecording) { walk("rawRecording", 20000); }
TEST(Mutations, Message) { walk("message", 20000); }
TEST(Mutations, Rvl) { walk("rvl", 20000); }
TEST(Mutations, Kinect) { walk("kinect", 3000); }
TEST(Mutations, Ros1) { walk("ros1", 3000); }
TEST(Mutations, Ros2) { walk("ros2", 3000); }
TEST(Mutations, Record3d) { walk("record3d", 10000); }
TEST(Mutations, R3d) { walk("r3d", 3000); }
TEST(Mutations, Lzfse) { walk("lzfse", 20000); }
TEST(Mutations, Stray) { walk("stray", 10000); }
TEST(Mutations, Tum) { walk("tum", 1000); }
TEST(Mutations, SevenScenes) { walk("sevenScenes", 1000); }
TEST(Mutations, Hololens) { walk("hololens", 20000); }
TEST(Mutations, Hl2ss) { walk("hl2ss", 10000); }
TEST(Mutations, Hl2ssFolder) { walk("hl2ssFolder", 300); }
TEST(Mutations, Calibration) { walk("calibration", 20000); }
#endif
#ifdef SPHC_FUZZ_CAMERAS
TEST(Mutations, Mjpeg) { walk("mjpeg", 20000); }
TEST(Mutations, V4l2) { walk("v4l2", 5000); }
#endif
#ifdef SPHC_FUZZ_FOREIGN
TEST(Mutations, Foreign) { walk("foreign", 10000); }
#endif
#ifdef SPHC_FUZZ_COLMAP
TEST(Mutations, Colmap) { walk("colmap", 10000); }
TEST(Mutations, PointModel) { walk("pointModel", 20000); }
TEST(Mutations, ColmapDatabase) { walk("colmapDatabase", 1000); }
#endif
#ifdef SPHC_FUZZ_OWNER
TEST(Mutations, OwnerNote) { walk("ownerNote", 10000); }
TEST(Mutations, Ledger) { walk("ledger", 500); }

#endif

TEST(Mutations, FirstSeedsAreAccepted) {  // else mutations would all end where the seed does
  for (const Target &target : allTargets()) {
    const uint64_t before = acceptedCount();
    target.run(target.seeds[0].data(), target.seeds[0].size());
    EXPECT_GT(acceptedCount(), before) << target.name;
  }
}

}  // namespace
}  // namespace sphc::fuzz
