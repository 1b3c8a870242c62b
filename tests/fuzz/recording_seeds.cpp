#include "tests/fuzz/recording_seeds.h"

#include "host/recording/encoded_image.h"
#include "host/recording/mcap/depth_rvl.h"
#include "host/recording/mcap/depth_zstd.h"
#include "host/recording/mcap/messages.h"
#include "host/recording/recorder.h"
#include "host/recording/writer_raw.h"
#include "tests/support/temp_folder.h"

namespace sphc::fuzz {
namespace {

constexpr uint32_t kSide = 16;

// A step, a slope and a hole.
std::vector<uint16_t> depthPixels() {
  std::vector<uint16_t> depth(kSide * kSide);
  for (size_t i = 0; i < depth.size(); ++i)
    depth[i] = static_cast<uint16_t>(i % 33 < 5 ? 0 : i % 50 < 20 ? 900 + i : 3000);
  return depth;
}

std::vector<uint8_t> colorPixels() {
  std::vector<uint8_t> color(kSide * kSide * 3);
  for (size_t i = 0; i < color.size(); ++i) color[i] = static_cast<uint8_t>(i * 7);
  return color;
}

sphc_rig smallCalibration() {
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  calibration.color_camera = {SPHC_CAMERA_PINHOLE, kSide, kSide, 4, {20, 20, 8, 8}};
  calibration.depth_camera = calibration.color_camera;
  return calibration;
}

std::vector<uint8_t> seedIn(const test::TempFolder &folder) {
  const std::string text = folder.read("seed");
  return {text.begin(), text.end()};
}

std::vector<uint8_t> recordedFile(sphc_depth_codec codec, uint32_t jpeg_quality) {
  const test::TempFolder folder;
  const sphc_rig calibration = smallCalibration();
  sphc_recorder_config config;
  sphc_recorder_config_init(&config, sizeof config);
  config.depth_codec = codec;
  config.jpeg_quality = jpeg_quality;
  sphc_recorder *recorder = nullptr;
  sphc_recorder_open((folder / "seed").c_str(), &calibration, &config, &recorder, nullptr);
  const std::vector<uint16_t> depth = depthPixels();
  const std::vector<uint8_t> color = colorPixels();
  for (uint32_t i = 0; i < 6; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    capture.stream = i % 2 ? SPHC_STREAM_DEPTH : SPHC_STREAM_COLOR;
    capture.time_ns = 1000 + 10 * i;
    capture.sequence = i;
    capture.image = i % 2 ? sphc_image{depth.data(), kSide, kSide, kSide * 2, SPHC_FORMAT_DEPTH16}
                          : sphc_image{color.data(), kSide, kSide, kSide * 3, SPHC_FORMAT_BGR8};
    if (i == 3) capture.amplitude = {depth.data(), kSide, kSide, kSide * 2, SPHC_FORMAT_GRAY16};
    sphc_recorder_add(recorder, &capture, nullptr);
    const sphc_rigid pose = {{1, 0, 0, 0}, {0.1 * i, 0, 0}};
    sphc_recorder_add_pose(recorder, 1000 + 10 * i, &pose, nullptr);
    const double felt_mps2[3] = {0, -9.8, 0.1 * i};
    sphc_recorder_add_acceleration(recorder, 1000 + 10 * i, felt_mps2, nullptr);
  }
  sphc_recorder_close(&recorder, nullptr);
  return seedIn(folder);
}

// By the list of kinds in fuzz_recording.cpp.
std::vector<uint8_t> begun(recording::Kind kind) {
  const int number = static_cast<int>(kind), first_amplitude = static_cast<int>(recording::Kind::kAmplitudeImage);
  return {static_cast<uint8_t>(recording::isAmplitude(kind) ? 5 + number - first_amplitude : number - 1)};
}

}  // namespace

std::vector<std::vector<uint8_t>> recordingSeeds() {
  const std::vector<uint8_t> whole = recordedFile(SPHC_DEPTH_RVL, 0);
  const std::vector<uint8_t> cut(whole.begin(), whole.end() - static_cast<ptrdiff_t>(whole.size() / 4));
  return {whole, recordedFile(SPHC_DEPTH_ZSTD, 90), recordedFile(SPHC_DEPTH_RAW, 0), cut};
}

std::vector<std::vector<uint8_t>> rawRecordingSeeds() {
  const test::TempFolder folder;
  const std::vector<uint16_t> depth = depthPixels();
  const std::vector<uint8_t> color = colorPixels();
  recording::RawWriter writer(folder / "seed", smallCalibration(), SPHC_FORMAT_BGR8);
  for (uint32_t i = 0; i < 2; ++i) {
    sphc_localizer_frame frame = {};
    frame.struct_size = sizeof frame;
    frame.sequence = i;
    frame.color_time_ns = 1000 + 10 * i;
    frame.depth_time_ns = 1005 + 10 * i;
    frame.color = {color.data(), kSide, kSide, kSide * 3, SPHC_FORMAT_BGR8};
    frame.depth = {depth.data(), kSide, kSide, kSide * 2, SPHC_FORMAT_DEPTH16};
    const sphc_rigid pose = {{1, 0, 0, 0}, {0.1 * i, 0, 0}};
    writer.add(frame, i ? &pose : nullptr);
  }
  writer.finish();
  std::vector<uint8_t> as_it_is = seedIn(folder), repaired = as_it_is;
  as_it_is.insert(as_it_is.begin(), uint8_t{1});
  repaired.insert(repaired.begin(), uint8_t{0});
  return {as_it_is, repaired};
}

std::vector<std::vector<uint8_t>> messageSeeds() {
  using namespace recording;
  const std::vector<uint16_t> depth = depthPixels();
  const std::vector<uint8_t> color = colorPixels();
  const sphc_image color_image = {color.data(), kSide, kSide, kSide * 3, SPHC_FORMAT_BGR8};
  const sphc_image depth_image = {depth.data(), kSide, kSide, kSide * 2, SPHC_FORMAT_DEPTH16};
  const sphc_image amplitude_image = {depth.data(), kSide, kSide, kSide * 2, SPHC_FORMAT_GRAY16};
  Bytes raw_color = begun(Kind::kColorImage), raw_depth = begun(Kind::kDepthImage), jpeg = begun(Kind::kColorJpeg),
        rvl_message = begun(Kind::kDepthRvl), zstd_message = begun(Kind::kDepthZstd),
        raw_amplitude = begun(Kind::kAmplitudeImage), zstd_amplitude = begun(Kind::kAmplitudeZstd);
  putImageMessage(raw_amplitude, 5, amplitude_image);
  putImageMessage(raw_color, 5, color_image);
  putImageMessage(raw_depth, 5, depth_image);
  ImageEncoder encoder;
  putCompressedMessage(jpeg, 5, Kind::kColorJpeg, encoder.jpeg(color_image, 90));
  Bytes encoded(kRvlHeadBytes + rvlMostBytes(depth.size()));
  putRvlHead(encoded.data(), kSide, kSide);
  encoded.resize(kRvlHeadBytes + encodeRvl(depth.data(), depth.size(), encoded.data() + kRvlHeadBytes));
  putCompressedMessage(rvl_message, 5, Kind::kDepthRvl, viewOf(encoded));
  encoded.assign(kZstdHeadBytes + DepthZstdEncoder::mostBytes(depth.size()), 0);
  putZstdHead(encoded.data(), kSide, kSide);
  encoded.resize(kZstdHeadBytes + DepthZstdEncoder(depth.size())
                                      .encode(depth.data(), depth.size(), encoded.data() + kZstdHeadBytes,
                                              encoded.size() - kZstdHeadBytes));
  putCompressedMessage(zstd_message, 5, Kind::kDepthZstd, viewOf(encoded));
  putCompressedMessage(zstd_amplitude, 5, Kind::kAmplitudeZstd, viewOf(encoded));
  return {raw_color, raw_depth, jpeg, rvl_message, zstd_message, raw_amplitude, zstd_amplitude};
}

std::vector<std::vector<uint8_t>> rvlSeeds() {
  std::vector<uint16_t> depth = depthPixels();
  depth.resize(300, 77);
  std::vector<uint8_t> encoded(recording::rvlMostBytes(depth.size()));
  encoded.resize(recording::encodeRvl(depth.data(), depth.size(), encoded.data()));
  return {encoded};
}

}  // namespace sphc::fuzz
