#include "drivers.h"
#include "drivers/sample/sample.h"

namespace sphc::contract {

namespace {

OpenedDriver openSample(uint32_t frames) {
  sphc_sample *sample = nullptr;
  sphc_sample_open(frames, &sample, nullptr);
  OpenedDriver opened{{}, {sample, [](sphc_sample *closing) { sphc_sample_close(&closing); }}};
  sphc_sample_source(sample, &opened.source);
  return opened;
}

}  // namespace

std::vector<Driver> sampleDrivers() {
  return {{"Sample", [] { return openSample(0); }}, {"SampleThatEnds", [] { return openSample(10); }, 20}};
}

}  // namespace sphc::contract
