// config.h - what a config may say.
#pragma once

#include "drivers/simulated/simulated.h"

namespace sphc::simulated {

// Writes a formatted explanation; accepts null.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void explain(sphc_message *message, const char *format, ...);

sphc_status checkConfig(const sphc_simulated_config *config, sphc_message *message);

}  // namespace sphc::simulated
