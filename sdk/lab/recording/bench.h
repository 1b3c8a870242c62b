// How small depth images become, how long that takes, and what a whole recorder costs.
#pragma once
#include <functional>
#include <nlohmann/json.hpp>

#include "host/recording/recorder.h"
#include "host/recording/recording_reader.h"
#include "lab/recording/codec.h"

namespace sphc::host {

struct CodecRow {
  std::string name;
  double ratio = 0;                     // raw bytes to stored ones, of all frames together
  double worst_ratio = 0;               // of one frame
  double encode_ms = 0, decode_ms = 0;  // medians over the frames
  double times_slower = 0;              // to encode than the first codec, ratio of the medians
};

struct CodecTable {
  std::string name;
  uint32_t width = 0, height = 0;
  size_t frames = 0;
  std::vector<CodecRow> rows;
};

using FrameDone = std::function<void(uint32_t done, uint32_t total)>;
// Every frame through every codec in turn; throws std::runtime_error when one does not give back what went in.
CodecTable runCodecBench(const std::string &name, uint32_t width, uint32_t height,
                         const std::vector<std::vector<uint16_t>> &frames, uint32_t repeats, const FrameDone &done);

struct RecorderCost {
  double depth_cpu_percent = 0;  // of one core, for depth alone at 30 Hz
  double both_cpu_percent = 0;   // likewise, colour (raw) and depth
  double bytes_per_second = 0;   // of the file, both at 30 Hz
};
// Records the recording's frames that can be read, one at least, into `folder` and removes the files again;
// processor time of all threads.
RecorderCost measureRecorder(recording::RecordingReader *reader, const std::string &folder);

std::string codecText(const CodecTable &table);
// No times, which are of one machine, but ratios.
std::string codecResults(const std::vector<CodecTable> &tables);
nlohmann::ordered_json codecJson(const std::vector<CodecTable> &tables);

}  // namespace sphc::host
