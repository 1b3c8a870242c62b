// Captures and times of devices, as hostile ones may tell them.
#include <cmath>
#include <set>

#include "spherecloud/spherecloud_capture.h"
#include "tests/fuzz/arguments.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

// Mostly a little later, at times any time at all.
int64_t anyTime(int64_t last_ns, Reader *reader) {
  const uint8_t how = reader->next();
  if (how >= 235) return static_cast<int64_t>(uint64_t{reader->take32()} << 32 | reader->take32());
  const uint64_t step_ns = uint64_t{1000000} * reader->next();
  return static_cast<int64_t>(static_cast<uint64_t>(last_ns) + (how < 220 ? step_ns : 0 - step_ns));
}

// One pairer, and which captures are on loan to it.
class Pairing {
 public:
  explicit Pairing(Reader *reader) : reader_(*reader) {
    sphc_pairer_config_init(&config_, sizeof config_);
    config_.slots = around(1 + reader_.next() % SPHC_PAIRER_SLOTS, &reader_);
    config_.tolerance_ns = reader_.next() < 200 ? 100000 * reader_.next() : anyTime(0, &reader_);
    sphc_message message = {};
    const sphc_status status = sphc_pairer_init(memory_, sizeof memory_, &config_, &pairer_, &message);
    if (status > 0 || (status < 0 && (pairer_ || !message.text[0])))
      broken("a refusal is a failure that explains itself");
  }
  void play() {
    if (!pairer_) return;
    while (!reader_.isAtEnd()) {
      push();
      if (reader_.next() < 200) popAll();
    }
    sphc_pairer_flush(pairer_);
    popAll();
    if (!loans_.empty()) broken("all captures come out");
    sphc_pairer_fini(&pairer_);
  }

 private:
  void push() {
    sphc_capture capture = {};
    capture.struct_size = around(sizeof capture, &reader_);
    const uint8_t kind = reader_.next();
    capture.stream = kind < 250 ? 1 + kind % 2 : static_cast<sphc_stream>(reader_.take32());
    capture.time_ns = time_ns_ = anyTime(time_ns_, &reader_);
    capture.time_point = reader_.next() % 5;
    capture.exposure_us = around(10000, &reader_);
    capture.sequence = around(++sequence_, &reader_);
    capture.clock = reader_.next() < 250 ? SPHC_CLOCK_SOURCE : SPHC_CLOCK_MONOTONIC;
    capture.token = ++token_;
    if (sphc_pairer_push(pairer_, &capture) == SPHC_OK) loans_.insert(capture.token);
  }
  void takeBack(const sphc_capture &capture) {
    if (loans_.erase(capture.token) != 1) broken("a capture comes out once");
  }
  void popAll() {
    for (;;) {
      sphc_capture color = {}, depth = {}, dropped = {};
      const sphc_status status = sphc_pairer_pop(pairer_, &color, &depth, &dropped);
      if (status == SPHC_OK) {
        takeBack(color);
        takeBack(depth);
        if (color.stream != SPHC_STREAM_COLOR || depth.stream != SPHC_STREAM_DEPTH)
          broken("a pair is of both streams");
        accept();
      } else if (dropped.stream != SPHC_STREAM_NONE) {
        takeBack(dropped);
      } else {
        return;
      }
    }
  }

  Reader &reader_;
  sphc_pairer_config config_;
  alignas(64) uint8_t memory_[SPHC_PAIRER_BYTES_MAX];
  sphc_pairer *pairer_ = nullptr;
  std::set<uint64_t> loans_;
  int64_t time_ns_ = 0;
  uint64_t token_ = 0;
  uint32_t sequence_ = 0;
};

void checkMapping(const sphc_clock_mapper *mapper, const sphc_clock_mapper_config &config) {
  sphc_clock_mapping mapping = {};
  mapping.struct_size = sizeof mapping;
  if (sphc_clock_mapper_get(mapper, &mapping) != SPHC_OK) broken("a mapper with samples tells its mapping");
  if (!(std::abs(mapping.drift_ppm) <= config.max_drift_ppm * (1 + 1e-9)) || mapping.sigma_ns < 0)
    broken("a mapping keeps to the config");
}

}  // namespace

void pairer(const uint8_t *data, size_t bytes) {
  Reader reader(data, bytes);
  Pairing(&reader).play();
}

void clockMapper(const uint8_t *data, size_t bytes) {
  Reader reader(data, bytes);
  sphc_clock_mapper_config config;
  sphc_clock_mapper_config_init(&config, sizeof config);
  config.max_drift_ppm = around(200, &reader);
  for (int64_t *value : {&config.window_ns, &config.delay_ns, &config.delay_sigma_ns, &config.jump_ns})
    if (reader.next() < 100) *value = anyTime(0, &reader);
  alignas(64) uint8_t memory[SPHC_CLOCK_MAPPER_BYTES_MAX];
  sphc_clock_mapper *mapper = nullptr;
  sphc_message message = {};
  if (sphc_clock_mapper_init(memory, sizeof memory, &config, &mapper, &message) != SPHC_OK) {
    if (!message.text[0]) broken("a refusal explains itself");
    return;
  }
  int64_t source_ns = 0, arrival_ns = 0, host_ns = 0;
  while (!reader.isAtEnd()) {
    source_ns = anyTime(source_ns, &reader);
    arrival_ns = anyTime(arrival_ns, &reader);
    if (sphc_clock_mapper_add(mapper, source_ns, arrival_ns) < 0) broken("a sample is taken");
    checkMapping(mapper, config);
    accept();
    sphc_clock_mapper_map(mapper, anyTime(source_ns, &reader), &host_ns);
  }
  sphc_clock_mapper_fini(&mapper);
}

}  // namespace sphc::fuzz
