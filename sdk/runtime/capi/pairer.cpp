#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"
#include "runtime/stages/capture/middle.h"

namespace {

constexpr sphc_pairer_config kDefaults = {sizeof kDefaults, 4, 20000000};

}  // namespace

sphc_status sphc_pairer_config_init(sphc_pairer_config *config, size_t struct_size) {
  return sphc::initStruct(kDefaults, struct_size, config);
}

sphc_status sphc_pairer_memory(sphc_memory *memory) {
  static_assert(sizeof(sphc_pairer) <= SPHC_PAIRER_BYTES_MAX);
  if (!memory) return SPHC_E_ARGUMENT;
  *memory = {sizeof(sphc_pairer), 0, alignof(sphc_pairer), 0};
  return SPHC_OK;
}

sphc_status sphc_pairer_init(void *memory, size_t memory_bytes, const sphc_pairer_config *config,
                             sphc_pairer **pairer, sphc_message *message) {
  sphc_pairer_config own = kDefaults;
  sphc_status status = sphc::readStruct("config", config, &own, message);
  if (status != SPHC_OK) return status;
  if (!pairer) {
    sphc::MessageWriter(message) << "pairer is null; give a pointer to set";
    return SPHC_E_ARGUMENT;
  }
  if (own.slots < 1 || own.slots > SPHC_PAIRER_SLOTS || own.tolerance_ns < 0) {
    sphc::MessageWriter(message) << "pairer slots " << own.slots << " must be 1 to " << SPHC_PAIRER_SLOTS
                                 << ", tolerance_ns " << own.tolerance_ns << " not negative";
    return SPHC_E_ARGUMENT;
  }
  status = sphc::checkMemory(memory, memory_bytes, sizeof(sphc_pairer), alignof(sphc_pairer), "pairer", message);
  if (status != SPHC_OK) return status;
  *pairer = new (memory) sphc_pairer{sphc::Pairer(own)};
  return SPHC_OK;
}

void sphc_pairer_fini(sphc_pairer **pairer) {
  if (pairer) *pairer = nullptr;
}

sphc_status sphc_pairer_push(sphc_pairer *pairer, const sphc_capture *capture) {
  if (!pairer || !capture) return SPHC_E_ARGUMENT;
  if (capture->struct_size != sizeof(sphc_capture)) return SPHC_E_STRUCT_SIZE;
  return pairer->pairer.push(*capture);
}

sphc_status sphc_pairer_pop(sphc_pairer *pairer, sphc_capture *color, sphc_capture *depth, sphc_capture *dropped) {
  if (!pairer || !color || !depth || !dropped) return SPHC_E_ARGUMENT;
  return pairer->pairer.pop(color, depth, dropped);
}

int64_t sphc_capture_middle_ns(const sphc_capture *capture) { return capture ? sphc::middleNs(*capture) : 0; }

sphc_status sphc_pairer_get_counts(const sphc_pairer *pairer, sphc_pairer_counts *counts) {
  if (!pairer || !counts) return SPHC_E_ARGUMENT;
  uint32_t struct_size = 0;
  const sphc_status status = sphc::checkStruct("counts", counts, nullptr, &struct_size);
  if (status == SPHC_OK) sphc::writeStruct(pairer->pairer.counts(), struct_size, counts);
  return status;
}

void sphc_pairer_flush(sphc_pairer *pairer) {
  if (pairer) pairer->pairer.flush();
}
