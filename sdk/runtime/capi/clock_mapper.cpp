#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"

namespace {

constexpr int64_t kSecondNs = 1000000000, kHourNs = 3600 * kSecondNs;

bool isInRange(const sphc_clock_mapper_config &config) {
  const auto within = [](int64_t value, int64_t least, int64_t most) { return value >= least && value <= most; };
  return within(config.max_drift_ppm, 1, 10000) && within(config.window_ns, kSecondNs, kHourNs) &&
         within(config.delay_ns, -kHourNs, kHourNs) && within(config.delay_sigma_ns, 0, kHourNs) &&
         within(config.jump_ns, 1, kHourNs);
}

constexpr sphc_clock_mapper_config kDefaults = {sizeof kDefaults, 200, 20 * kSecondNs, 0, 1000000, 50000000};

}  // namespace

sphc_status sphc_clock_mapper_config_init(sphc_clock_mapper_config *config, size_t struct_size) {
  return sphc::initStruct(kDefaults, struct_size, config);
}

sphc_status sphc_clock_mapper_memory(sphc_memory *memory) {
  static_assert(sizeof(sphc_clock_mapper) <= SPHC_CLOCK_MAPPER_BYTES_MAX);
  if (!memory) return SPHC_E_ARGUMENT;
  *memory = {sizeof(sphc_clock_mapper), 0, alignof(sphc_clock_mapper), 0};
  return SPHC_OK;
}

sphc_status sphc_clock_mapper_init(void *memory, size_t memory_bytes, const sphc_clock_mapper_config *config,
                                   sphc_clock_mapper **mapper, sphc_message *message) {
  sphc_clock_mapper_config own = kDefaults;
  sphc_status status = sphc::readStruct("config", config, &own, message);
  if (status != SPHC_OK) return status;
  if (!mapper) {
    sphc::MessageWriter(message) << "mapper is null; give a pointer to set";
    return SPHC_E_ARGUMENT;
  }
  if (!isInRange(own)) {
    sphc::MessageWriter(message) << "clock mapper config: max_drift_ppm " << own.max_drift_ppm
                                 << " must be 1 to 10000, window_ns " << own.window_ns << " 1 s to 1 h, delay_ns "
                                 << own.delay_ns << " within 1 h, delay_sigma_ns " << own.delay_sigma_ns
                                 << " 0 to 1 h, jump_ns " << own.jump_ns << " 1 ns to 1 h";
    return SPHC_E_ARGUMENT;
  }
  status = sphc::checkMemory(memory, memory_bytes, sizeof(sphc_clock_mapper), alignof(sphc_clock_mapper),
                             "clock mapper", message);
  if (status != SPHC_OK) return status;
  *mapper = new (memory) sphc_clock_mapper{sphc::ClockMapper(own)};
  return SPHC_OK;
}

void sphc_clock_mapper_fini(sphc_clock_mapper **mapper) {
  if (mapper) *mapper = nullptr;
}

sphc_status sphc_clock_mapper_add(sphc_clock_mapper *mapper, int64_t source_time_ns, int64_t arrival_ns) {
  return mapper ? mapper->mapper.add(source_time_ns, arrival_ns) : sphc_status{SPHC_E_ARGUMENT};
}

sphc_status sphc_clock_mapper_map(const sphc_clock_mapper *mapper, int64_t source_time_ns, int64_t *host_time_ns) {
  return mapper && host_time_ns ? mapper->mapper.map(source_time_ns, host_time_ns) : sphc_status{SPHC_E_ARGUMENT};
}

sphc_status sphc_clock_mapper_get(const sphc_clock_mapper *mapper, sphc_clock_mapping *mapping) {
  if (!mapper || !mapping) return SPHC_E_ARGUMENT;
  uint32_t struct_size = 0;
  const sphc_status writable = sphc::checkStruct("mapping", mapping, nullptr, &struct_size);
  if (writable != SPHC_OK) return writable;
  sphc_clock_mapping own = {};
  const sphc_status status = mapper->mapper.get(&own);
  if (status == SPHC_OK) sphc::writeStruct(own, struct_size, mapping);
  return status;
}
