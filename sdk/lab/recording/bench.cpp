#include "lab/recording/bench.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>

#include "host/frames/recording.h"
#include "host/report/statistics.h"
#include "lab/common/interleave.h"

namespace sphc::host {
namespace {

struct Gathered {
  double stored_bytes = 0, worst_ratio = std::numeric_limits<double>::infinity();
  std::vector<double> encode_s, decode_s;
};

void requireSame(const DepthCodec &codec, const std::vector<uint16_t> &frame, const EncodedDepth &encoded,
                 std::vector<uint16_t> *back) {
  std::fill(back->begin(), back->end(), uint16_t{12345});
  if (!codec.decode(encoded, back) || *back != frame)
    throw std::runtime_error(codec.name + " does not give back the depth image that went in: a defect");
}

void gather(const DepthCodec &codec, const std::vector<uint16_t> &frame, uint32_t repeats, Gathered *g) {
  EncodedDepth encoded;
  std::vector<uint16_t> back(frame.size());
  std::vector<double> encode_s, decode_s;
  for (uint32_t i = 0; i < repeats; ++i) {
    const double start = threadCpuSeconds();
    codec.encode(frame, &encoded);
    const double middle = threadCpuSeconds();
    codec.decode(encoded, &back);
    encode_s.push_back(middle - start);
    decode_s.push_back(threadCpuSeconds() - middle);
  }
  requireSame(codec, frame, encoded, &back);
  g->encode_s.push_back(percentile(encode_s, 0.5));
  g->decode_s.push_back(percentile(decode_s, 0.5));
  g->stored_bytes += static_cast<double>(encoded.size());
  g->worst_ratio =
      std::min(g->worst_ratio, 2 * static_cast<double>(frame.size()) / static_cast<double>(encoded.size()));
}

double processCpuSeconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval &t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

sphc_capture captureOf(const sphc_localizer_frame &frame, sphc_stream stream, uint32_t i) {
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  capture.stream = stream;
  capture.time_ns = int64_t{i} * 33333333;
  capture.sequence = i;
  capture.image = stream == SPHC_STREAM_COLOR ? frame.color : frame.depth;
  return capture;
}

void orFail(sphc_status status, const sphc_message &message) {
  if (status != SPHC_OK) throw std::runtime_error(std::string("cannot record: ") + message.text);
}

struct Recorded {
  uint32_t frames = 0;
  double seconds = 0;  // of the processor, a frame, without reading it
};

// Those that can be read.
Recorded record(RecordingReader *reader, const std::string &file, bool with_color) {
  const sphc_rig calibration = reader->calibration();
  sphc_recorder_config config;
  sphc_recorder_config_init(&config, sizeof config);
  config.wait_us = 60000000;
  sphc_message message = {};
  sphc_recorder *recorder = nullptr;
  orFail(sphc_recorder_open(file.c_str(), &calibration, &config, &recorder, &message), message);
  Recorded recorded;
  double reading_s = 0;
  const double start = processCpuSeconds();
  for (uint32_t i = 0; i < reader->frameCount(); ++i) {
    const double before = threadCpuSeconds();
    const std::optional<sphc_localizer_frame> frame = reader->tryRead(i);
    reading_s += threadCpuSeconds() - before;
    if (!frame) continue;
    ++recorded.frames;
    const sphc_capture color = captureOf(*frame, SPHC_STREAM_COLOR, i);
    const sphc_capture depth = captureOf(*frame, SPHC_STREAM_DEPTH, i);
    if (with_color) orFail(sphc_recorder_add(recorder, &color, &message), message);
    orFail(sphc_recorder_add(recorder, &depth, &message), message);
  }
  orFail(sphc_recorder_close(&recorder, &message), message);
  recorded.seconds = (processCpuSeconds() - start - reading_s) / recorded.frames;
  return recorded;
}

}  // namespace

CodecTable runCodecBench(const std::string &name, uint32_t width, uint32_t height,
                         const std::vector<std::vector<uint16_t>> &frames, uint32_t repeats,
                         const FrameDone &done) {
  const std::vector<DepthCodec> codecs = depthCodecs(width, height);
  std::vector<Gathered> all(codecs.size());
  Random random(1);
  for (size_t i = 0; i < frames.size(); ++i) {
    done(static_cast<uint32_t>(i), static_cast<uint32_t>(frames.size()));
    for (const size_t k : shuffledOrder(codecs.size(), &random)) gather(codecs[k], frames[i], repeats, &all[k]);
  }
  CodecTable table = {name, width, height, frames.size(), {}};
  const double raw_bytes = 2.0 * width * height * static_cast<double>(frames.size());
  for (size_t k = 0; k < codecs.size(); ++k) {
    const Gathered &g = all[k];
    const double encode_ms = 1e3 * percentile(g.encode_s, 0.5);
    const double ours_ms = table.rows.empty() ? encode_ms : table.rows[0].encode_ms;
    table.rows.push_back({codecs[k].name, raw_bytes / g.stored_bytes, g.worst_ratio, encode_ms,
                          1e3 * percentile(g.decode_s, 0.5), encode_ms / ours_ms});
  }
  return table;
}

RecorderCost measureRecorder(recording::RecordingReader *reader, const std::string &folder) {
  constexpr double kRateHz = 30;
  const std::string file = folder + "/recorder_cost.mcap";
  const double depth_s = record(reader, file, false).seconds;
  std::filesystem::remove(file);
  const Recorded both = record(reader, file, true);
  const auto file_bytes = static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::remove(file);
  return {100 * kRateHz * depth_s, 100 * kRateHz * both.seconds, kRateHz * file_bytes / both.frames};
}

std::string codecText(const CodecTable &table) {
  std::string text = table.name + ", " + std::to_string(table.width) + " x " + std::to_string(table.height) + ", " +
                     std::to_string(table.frames) + " depth images\n";
  char line[160];
  std::snprintf(line, sizeof line, "  %-14s %9s %9s %10s %10s %8s\n", "", "smaller", "at least", "encode", "decode",
                "slower");
  text += line;
  for (const CodecRow &row : table.rows) {
    std::snprintf(line, sizeof line, "  %-14s %8.2fx %8.2fx %7.2f ms %7.2f ms %7.2fx\n", row.name.c_str(),
                  row.ratio, row.worst_ratio, row.encode_ms, row.decode_ms, row.times_slower);
    text += line;
  }
  return text;
}

std::string codecResults(const std::vector<CodecTable> &tables) {
  std::string text = "recording,width,height,frames,codec,times_smaller,times_smaller_worst,times_slower\n";
  char line[200];
  for (const CodecTable &table : tables)
    for (const CodecRow &row : table.rows) {
      std::snprintf(line, sizeof line, "%s,%u,%u,%zu,%s,%.2f,%.2f,%.1f\n", table.name.c_str(), table.width,
                    table.height, table.frames, row.name.c_str(), row.ratio, row.worst_ratio, row.times_slower);
      text += line;
    }
  return text;
}

nlohmann::ordered_json codecJson(const std::vector<CodecTable> &tables) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const CodecTable &table : tables)
    for (const CodecRow &row : table.rows)
      json.push_back({{"recording", table.name},
                      {"codec", row.name},
                      {"times_smaller", row.ratio},
                      {"encode_ms", row.encode_ms},
                      {"decode_ms", row.decode_ms},
                      {"times_slower", row.times_slower}});
  return json;
}

}  // namespace sphc::host
