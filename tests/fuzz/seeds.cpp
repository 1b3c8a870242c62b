#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/recording_seeds.h"
#include "tests/fuzz/targets.h"
#ifdef SPHC_FUZZ_CAMERAS
#include "tests/support/jpeg_frame.h"
#endif
#include "tests/support/golden_encryption.h"
#include "tests/support/golden_signature.h"
#include "tests/support/map_bytes.h"
#include "tests/support/scene.h"
#ifdef SPHC_FUZZ_FOREIGN
#include "host/calibration/formats.h"
#include "tests/unit/host/calibration/golden_files.h"
#endif
#ifdef SPHC_FUZZ_COLMAP
#include "host/import/model_file.h"
#include "tests/support/made_up_model.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/import/tiny_colmap.h"
#endif

namespace sphc::fuzz {
#ifdef SPHC_FUZZ_COLMAP
std::vector<uint8_t> colmapSeed(const host::ColmapFiles &files);  // fuzz_colmap.cpp
#endif
#ifdef SPHC_FUZZ_OWNER
std::vector<std::vector<uint8_t>> ownerNoteSeeds();  // fuzz_owner.cpp
std::vector<std::vector<uint8_t>> ledgerSeeds();
#endif
namespace {

std::vector<uint8_t> bytesOf(const std::string &text) { return {text.begin(), text.end()}; }

std::vector<uint8_t> signedMap() {
  std::vector<uint8_t> seed = test::bytesOfHex(test::kGoldenSignature);
  const std::vector<uint8_t> map = test::goldenMap();
  seed.insert(seed.end(), map.begin(), map.end());
  return seed;
}

std::vector<uint8_t> infraredMap() {
  std::vector<uint8_t> file = test::randomMap(16, 3);
  test::setBand(&file, SPHC_BAND_INFRARED);
  return file;
}

std::vector<uint8_t> frameSeed(uint32_t viewpoint) {
  const test::SceneImages images = test::renderScene(test::pinhole(96, 72, 80), test::pinhole(48, 40, 36),
                                                     test::sceneViewpoint(viewpoint), Rigid());
  constexpr size_t kFields = 76;  // all right where they are zeros: a grey image, no prior
  std::vector<uint8_t> seed(kFields + 320 * 96);
  std::copy(images.gray.begin(), images.gray.end(), seed.begin() + kFields);
  for (uint16_t mm : images.depth_mm) {
    seed.push_back(static_cast<uint8_t>(mm));
    seed.push_back(static_cast<uint8_t>(mm >> 8));
  }
  return seed;
}

using Bytes = std::vector<uint8_t>;

Bytes joined(const std::vector<Bytes> &parts) {
  Bytes all;
  for (const Bytes &part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Calls with sound arguments; Play::call and what it calls read them in this order.  The further cameras have
// images or not.
Bytes sessionSeed(uint8_t viewpoint, bool has_views) {
  const uint8_t image = has_views ? 255 : 0;
  const Bytes views = {0, 0, viewpoint, 0, image, 255, 255, 0, 0, 0, viewpoint, 0, image, 255, 0},
              images = joined({{viewpoint, 33, 0}, views, {255}}), set_maps = {2, 0, 0, 0, 2, 1, 0, 1},
              frame = joined({{0}, images}), place = {5, 0, 0, 60, 0, 128, 0, 192, 0, 128, 0, 129, 0, 129, 255},
              predict = {6, 0, 66}, parameter = {7, 0, 0, 0, 0, 184}, bias = {8, 255}, observe = {9, 79, 0},
              confidence = {10, 0, 131, 0, 134},
              camera = {11, 0, 0, 60, 0, 140, 0, 128, 0, 120, 60, 0, 128, 0, 130, 0, 140},
              map = {12, 1, 0, 0, 130, 0, 140, 0, 190}, remove = {4, 0, 0}, reset = {15}, rank = {14},
              halves = joined({{1}, images, {0}}), given = joined({{13, 255, 0, 0}, images, {1}, images, {255}});
  return joined({set_maps, frame,      rank,   frame, predict, place, frame,  bias,  frame,   parameter, frame,
                 observe,  confidence, camera, map,   halves,  given, remove, frame, predict, reset,     halves});
}

// Captures of both streams by turns, all of whose fields are sound.
std::vector<uint8_t> pairerSeed() {
  std::vector<uint8_t> seed = {3, 0, 0, 100};
  for (uint8_t i = 0; i < 20; ++i) seed.insert(seed.end(), {0, i, 0, 8, 0, 0, 0, 0, 0});
  return seed;
}

// The usual config, then samples 33 ms apart and times to be mapped.
std::vector<uint8_t> clockMapperSeed() {
  std::vector<uint8_t> seed = {0, 200, 200, 200, 200};
  for (int i = 0; i < 20; ++i) seed.insert(seed.end(), {0, 33, 0, 33, 0, 5});
  return seed;
}

// Two cameras of a model, and a depth image with a step and a hole.
std::vector<uint8_t> alignSeed(sphc_camera_model model, const std::vector<double> &distortion,
                               sphc_format depth_format = SPHC_FORMAT_DEPTH16) {
  sphc_aligner_config config;
  sphc_aligner_config_init(&config, sizeof config);
  config.depth_format = depth_format;
  config.rig.color_camera = test::pinhole(24, 20, 20);  // of the fuzzed sizes, 16 + these, folded
  config.rig.depth_camera = test::pinhole(17, 16, 15);
  for (sphc_camera *camera : {&config.rig.color_camera, &config.rig.depth_camera}) {
    camera->model = model;
    camera->param_count = static_cast<uint32_t>(4 + distortion.size());
    std::copy(distortion.begin(), distortion.end(), camera->params + 4);
  }
  config.rig.color_from_depth.t_m[0] = -0.05;
  const auto *start = reinterpret_cast<const uint8_t *>(&config);
  std::vector<uint8_t> seed(start, start + sizeof config);
  for (uint32_t i = 0; i < 200; ++i) {
    const uint16_t mm = static_cast<uint16_t>(i % 33 < 12 ? 900 + i : i % 33 < 15 ? 0 : 3000);
    seed.push_back(static_cast<uint8_t>(mm));
    seed.push_back(static_cast<uint8_t>(mm >> 8));
  }
  return seed;
}

#ifdef SPHC_FUZZ_RECORDINGS
const char *const kCalibration = R"({
  "format": "spherecloud-calibration",
  "version": 1,
  "pixel_center": 0.5,
  "color_camera": {"model": "pinhole", "width": 640, "height": 480, "params": [585, 585, 320, 240]},
  "depth_camera": {"model": "kannala_brandt4", "width": 320, "height": 288,
                   "params": [180, 181, 161, 144, -0.01, 0.02, -0.01, 0.002]},
  "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0.03, 0, 0]},
  "depth_unit_m": 0.001
}
)";
#endif

#ifdef SPHC_FUZZ_FOREIGN
std::vector<std::vector<uint8_t>> foreignSeeds() {
  using namespace sphc::host;
  const auto seed = [](Format format, const std::string &text) {
    return bytesOf(static_cast<char>(format) + text);
  };
  return {seed(Format::kKalibr, kKalibrFile),
          seed(Format::kRos, kRosColorFile),
          seed(Format::kOpencv, kOpencvSampleFile),
          seed(Format::kOpencv, kOpencvStereoFile),
          seed(Format::kColmap, std::string(kColmapCamerasFile) + '\0' + kColmapRigsFile),
          seed(Format::kAzureKinect, kAzureKinectFile)};
}
#endif

#ifdef SPHC_FUZZ_COLMAP
std::vector<uint8_t> databaseSeed(test::Schema schema) {
  const test::TempFolder folder;
  test::writeColmapDatabase(folder / "seed.db", test::tinyColmapModel(1), schema);
  return bytesOf(folder.read("seed.db"));
}
#endif

}  // namespace

void broken(const char *promise) {
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

namespace {
uint64_t accepted_count = 0;
}
void accept() { ++accepted_count; }
uint64_t acceptedCount() { return accepted_count; }

std::vector<Target> allTargets() {
  std::vector<Target> targets = {
      {"map", map, {test::randomMap(16, 1), test::randomMap(33, 2), infraredMap()}},
      {"mapRead", mapRead, {test::randomMap(16, 1), test::randomMap(33, 2), infraredMap()}},
      {"encryption", encryption, {test::goldenEncrypted()}},
      {"signature", signature, {signedMap(), test::bytesOfHex(test::kGoldenSignature)}},
      {"config", config, {std::vector<uint8_t>(200), std::vector<uint8_t>(200, 7), std::vector<uint8_t>(200, 130)}},
      {"pairer", pairer, {pairerSeed(), std::vector<uint8_t>(100)}},
      {"clockMapper",
       clockMapper,
       {clockMapperSeed(), std::vector<uint8_t>(100, 9), std::vector<uint8_t>(400, 30)}},
      {"frame", frame, {frameSeed(0), frameSeed(2), {}}},
      {"session", session, {sessionSeed(0, false), sessionSeed(1, true)}},
      {"align",
       align,
       {alignSeed(SPHC_CAMERA_PINHOLE, {}), alignSeed(SPHC_CAMERA_BROWN5, {0.1, -0.05, 0.001, 0, 0}),
        alignSeed(SPHC_CAMERA_BROWN8, {0.1, 0, 0, 0, 0, 0.1, 0, 0}),
        alignSeed(SPHC_CAMERA_KANNALA_BRANDT4, {0.02, -0.01, 0, 0}),
        alignSeed(SPHC_CAMERA_PINHOLE, {}, SPHC_FORMAT_RANGE_F32)}}};
#ifdef SPHC_FUZZ_FOREIGN
  targets.push_back({"foreign", foreign, foreignSeeds()});
#endif
#ifdef SPHC_FUZZ_RECORDINGS
  targets.push_back({"recording", recording, recordingSeeds()});
  targets.push_back({"rawRecording", rawRecording, rawRecordingSeeds()});
  targets.push_back({"message", message, messageSeeds()});
  targets.push_back({"rvl", rvl, rvlSeeds()});
  targets.push_back({"kinect", kinect, kinectSeeds()});
  targets.push_back({"ros1", ros1, ros1Seeds()});
  targets.push_back({"ros2", ros2, ros2Seeds()});
  targets.push_back({"record3d", record3d, record3dSeeds()});
  targets.push_back({"r3d", r3d, r3dSeeds()});
  targets.push_back({"lzfse", lzfse, lzfseSeeds()});
  targets.push_back({"stray", stray, straySeeds()});
  targets.push_back({"tum", tum, tumSeeds()});
  targets.push_back({"sevenScenes", sevenScenes, sevenScenesSeeds()});
  targets.push_back({"hololens", hololens, hololensSeeds()});
  targets.push_back({"hl2ss", hl2ss, hl2ssSeeds()});
  targets.push_back({"hl2ssFolder", hl2ssFolder, hl2ssFolderSeeds()});
  targets.push_back({"calibration", calibration, {bytesOf(kCalibration), bytesOf("{}"), bytesOf("[1e999]")}});
#endif
#ifdef SPHC_FUZZ_COLMAP
  const host::ColmapModel model = test::tinyColmapModel(2);
  targets.push_back({"colmap", colmap, {colmapSeed(test::binaryFiles(model)), colmapSeed(test::textFiles(model))}});
  targets.push_back(
      {"colmapDatabase", colmapDatabase, {databaseSeed(test::Schema::kOld), databaseSeed(test::Schema::kNew)}});
  host::PointModel infrared = test::madeUpRoom(2, 3);
  infrared.band = SPHC_BAND_INFRARED;
  targets.push_back({"pointModel",
                     pointModel,
                     {host::encodeModel(test::madeUpRoom(2, 1)), host::encodeModel(test::madeUpRoom(20, 2)),
                      host::encodeModel(infrared)}});
#endif
#ifdef SPHC_FUZZ_OWNER
  targets.push_back({"ownerNote", ownerNote, ownerNoteSeeds()});
  targets.push_back({"ledger", ledger, ledgerSeeds()});
#endif
#ifdef SPHC_FUZZ_CAMERAS
  const std::vector<uint8_t> rgb = test::gradientRgb(32, 16), frame = test::jpegFrame(rgb, 32, 16);
  targets.push_back(
      {"mjpeg", mjpeg, {frame, test::withoutHuffmanTables(frame), test::jpegFrame(rgb, 32, 16, TJSAMP_420)}});
  targets.push_back({"v4l2", v4l2, {std::vector<uint8_t>(600), std::vector<uint8_t>(1200)}});
#endif
  return targets;
}

}  // namespace sphc::fuzz
