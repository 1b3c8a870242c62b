#include "host/recording/foreign/kinect_accelerations.h"

#include <cmath>
#include <cstring>

#include "host/recording/foreign/time_order.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

namespace {

// A sample: time and three floats of the accelerometer, the same of the gyroscope.
constexpr uint64_t kSampleBytes = 40, kSampleHeadBytes = 20;
constexpr uint64_t kMostSizesBytes = 4 * 256;  // in front of the samples of a block

struct Sample {
  int64_t block_time_ns;
  uint64_t time, first_time;  // by the sensor's clock, in its unit: of the sample, of the first one in the block
  float felt_mps2[3];
};

// Samples are of one length, so they end where the block does, in whatever way their sizes are told.
bool isBlockOfSamples(const MatroskaBlock &block) {
  const uint64_t bytes = kSampleBytes * block.frame_count;
  return block.bytes >= bytes && block.bytes - bytes <= (block.frame_count > 1 ? kMostSizesBytes : 0);
}

std::vector<Sample> samplesOf(const std::filesystem::path &path, const MatroskaTrack &track, uint32_t *bad_count) {
  const File file(path);
  FileWindow window(file);
  std::vector<Sample> samples;
  for (const MatroskaBlock &block : track.blocks) {
    if (!isBlockOfSamples(block)) {
      *bad_count += block.frame_count;
      continue;
    }
    const uint64_t begin = block.start + block.bytes - kSampleBytes * block.frame_count;
    uint64_t first_time = 0;
    for (uint32_t i = 0; i < block.frame_count; ++i) {
      const ByteView bytes = window.at(begin + kSampleBytes * i, kSampleHeadBytes);
      Sample sample = {block.time_ns, loadLittle<uint64_t>(bytes.data), 0, {}};
      if (i == 0) first_time = sample.time;
      sample.first_time = first_time;
      std::memcpy(sample.felt_mps2, bytes.data + sizeof sample.time, sizeof sample.felt_mps2);
      samples.push_back(sample);
    }
  }
  return samples;
}

// Microseconds by the format's description, nanoseconds by what wrote the files: whichever agrees with most pairs
// of blocks that follow each other.
int64_t unitOf(const std::vector<Sample> &samples) {
  int64_t votes_for_microseconds = 0;
  for (size_t i = 1; i < samples.size(); ++i) {
    const double passed_ns = static_cast<double>(samples[i].block_time_ns - samples[i - 1].block_time_ns);
    const double told = static_cast<double>(samples[i].first_time) - static_cast<double>(samples[i - 1].first_time);
    if (passed_ns > 0 && told > 0) votes_for_microseconds += told * 30 < passed_ns ? 1 : -1;
  }
  return votes_for_microseconds > 0 ? 1000 : 1;
}

}  // namespace

std::vector<TimedAcceleration> kinectAccelerations(const std::filesystem::path &file, const MatroskaTrack &track,
                                                   int64_t start_ns, uint32_t *bad_count) {
  constexpr uint64_t kMostBlockNs = 1000000000;
  const std::vector<Sample> samples = samplesOf(file, track, bad_count);
  std::vector<TimedAcceleration> all;
  if (samples.empty()) return all;
  const int64_t unit_ns = unitOf(samples);
  for (const Sample &sample : samples) {
    const uint64_t since_first = sample.time - sample.first_time;  // huge where time goes back
    const float *felt = sample.felt_mps2;
    // Zero is what a sensor says that has not begun yet; nothing falls so.
    const float squared = felt[0] * felt[0] + felt[1] * felt[1] + felt[2] * felt[2];
    if (!(squared > 0) || !std::isfinite(squared) || since_first > kMostBlockNs / static_cast<uint64_t>(unit_ns))
      ++*bad_count;
    else
      all.push_back({start_ns + sample.block_time_ns + static_cast<int64_t>(since_first) * unit_ns,
                     {static_cast<double>(felt[0]), static_cast<double>(felt[1]), static_cast<double>(felt[2])}});
  }
  const size_t count = all.size();
  all = inOrderOfTime(std::move(all));
  *bad_count += static_cast<uint32_t>(count - all.size());
  return all;
}

}  // namespace sphc::recording
