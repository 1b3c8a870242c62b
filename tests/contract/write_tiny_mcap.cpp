// Writes small recordings for check_mcap.py: write_tiny_mcap FOLDER
#include "tiny_mcap.h"

using namespace sphc::contract;

namespace {

// Frames 0 to 39 without 10, 11 and 12.
void writeFile(const std::string &path, const sphc_recorder_config &config) {
  OpenRecorder recorder(path, config);
  ASSERT_EQ(recorder.status(), SPHC_OK) << recorder.message();
  for (uint32_t i = 0; i < 40; ++i) {
    if (i >= 10 && i <= 12) continue;
    const TinyImages images(i);
    const std::vector<uint16_t> amplitude = tinyAmplitude(i);
    for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
      sphc_capture capture = tinyCapture(i, stream, images);
      if (stream == SPHC_STREAM_DEPTH) capture.amplitude = amplitudeImage(amplitude);
      ASSERT_EQ(sphc_recorder_add(recorder.get(), &capture, nullptr), SPHC_OK);
    }
    const sphc_rigid pose = tinyPose(i);
    ASSERT_EQ(sphc_recorder_add_pose(recorder.get(), kFirstNs + i * kPeriodNs, &pose, nullptr), SPHC_OK);
  }
  ASSERT_EQ(recorder.close(), SPHC_OK) << recorder.message();
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  sphc_recorder_config config = recorderConfig();
  config.chunk_bytes = 65536;
  for (const auto &[codec, name] :
       {std::pair{SPHC_DEPTH_RAW, "raw"}, {SPHC_DEPTH_RVL, "rvl"}, {SPHC_DEPTH_ZSTD, "zstd"}}) {
    config.depth_codec = codec;
    writeFile(folder + "/" + name + ".mcap", config);
  }
  config.jpeg_quality = 90;
  writeFile(folder + "/jpeg.mcap", config);
  return testing::Test::HasFailure() ? 1 : 0;
}
