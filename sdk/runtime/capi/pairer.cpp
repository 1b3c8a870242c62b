#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/objects.h"
#include "runtime/stages/capture/middle.h"

sphc_status sphc_pairer_config_init(sphc_pairer_config *config, size_t struct_size) {
  if (!config) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof(sphc_pairer_config)) return SPHC_E_STRUCT_SIZE;
  *config = {static_cast<uint32_t>(struct_size), 4, 20000000};
  return SPHC_OK;
}

sphc_status sphc_pairer_memory(size_t *bytes, size_t *alignment) {
  if (!bytes || !alignment) return SPHC_E_ARGUMENT;
  *bytes = sizeof(sphc_pairer);
  *alignment = alignof(sphc_pairer);
  return SPHC_OK;
}

sphc_status sphc_pairer_init(void *memory, size_t memory_bytes, const sphc_pairer_config *config,
                             sphc_pairer **pairer, sphc_message *message) {
  if (!config || !pairer) {
    sphc::MessageWriter(message) << (config ? "pairer" : "config") << " is null";
    return SPHC_E_ARGUMENT;
  }
  if (config->struct_size != sizeof(sphc_pairer_config)) {
    sphc::MessageWriter(message) << "pairer config.struct_size is " << config->struct_size
                                 << "; call sphc_pairer_config_init first";
    return SPHC_E_STRUCT_SIZE;
  }
  if (config->slots < 1 || config->slots > SPHC_PAIRER_SLOTS || config->tolerance_ns < 0) {
    sphc::MessageWriter(message) << "pairer slots " << config->slots << " must be 1 to " << SPHC_PAIRER_SLOTS
                                 << ", tolerance_ns " << config->tolerance_ns << " not negative";
    return SPHC_E_ARGUMENT;
  }
  const sphc_status status =
      sphc::checkMemory(memory, memory_bytes, sizeof(sphc_pairer), alignof(sphc_pairer), "pairer", message);
  if (status != SPHC_OK) return status;
  *pairer = new (memory) sphc_pairer{sphc::Pairer(*config)};
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

sphc_status sphc_pairer_pop(sphc_pairer *pairer, sphc_pair *pair, sphc_capture *dropped) {
  if (!pairer || !pair || !dropped) return SPHC_E_ARGUMENT;
  if (pair->struct_size != sizeof(sphc_pair)) return SPHC_E_STRUCT_SIZE;
  return pairer->pairer.pop(pair, dropped);
}

int64_t sphc_capture_middle_ns(const sphc_capture *capture) { return capture ? sphc::middleNs(*capture) : 0; }

sphc_status sphc_pairer_get_counts(const sphc_pairer *pairer, sphc_pairer_counts *counts) {
  if (!pairer || !counts) return SPHC_E_ARGUMENT;
  if (counts->struct_size != sizeof(sphc_pairer_counts)) return SPHC_E_STRUCT_SIZE;
  *counts = pairer->pairer.counts();
  counts->struct_size = sizeof *counts;
  return SPHC_OK;
}

void sphc_pairer_flush(sphc_pairer *pairer) {
  if (pairer) pairer->pairer.flush();
}
