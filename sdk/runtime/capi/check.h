// Validation of what comes through the door.
#pragma once
#include "spherecloud/spherecloud.h"

namespace sphc {

// Copies a growing struct of any known size; what the caller's version lacks keeps its default.
sphc_status readConfig(const sphc_config *config, sphc_config *copy, sphc_message *message);
// Do a frame's images fit the config?
sphc_status checkFrame(const sphc_frame *frame, const sphc_config &config, uint32_t map_count,
                       sphc_message *message);
// Is every map of the list there, and are there not too many?
sphc_status checkMaps(const sphc_map *const *maps, uint32_t map_count, sphc_message *message);
// Is memory there, aligned and large enough?  `what` names it in the message.
sphc_status checkMemory(const void *memory, size_t bytes, size_t needed, size_t alignment, const char *what,
                        sphc_message *message);

}  // namespace sphc
