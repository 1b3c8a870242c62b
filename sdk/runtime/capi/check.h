// Validation of what comes through the C interface.
#pragma once
#include "spherecloud/spherecloud.h"

namespace sphc {

sphc_config defaultConfig();
sphc_aligner_config defaultAlignerConfig();
// Copies of what the caller gave, of any version (growth.h), and whether it can be used.
sphc_status readConfig(const sphc_config *config, sphc_config *copy, sphc_message *message);
sphc_status readAlignerConfig(const sphc_aligner_config *config, sphc_aligner_config *copy, sphc_message *message);
// What a frame must fit.
struct FrameLimits {
  const sphc_camera &color, &depth;
  uint32_t map_count;
  bool has_clock;
};
// What is copied points to `prior`, where the caller gave one.
struct FrameCopy {
  sphc_frame frame;
  sphc_prior prior;
};
sphc_status readFrame(const sphc_frame *frame, const FrameLimits &limits, FrameCopy *copy, sphc_message *message);
// Is every map of the list there, and are there not too many?
sphc_status checkMaps(const sphc_map *const *maps, uint32_t map_count, sphc_message *message);
// Does an image fit its camera?  `name` is that of the image; `depth`: it must be DEPTH16, else colour or grey.
sphc_status checkImage(const char *name, const sphc_image &image, const sphc_camera &camera, bool depth,
                       sphc_message *message);
// Is memory there, aligned and large enough?  `what` names it in the message.
sphc_status checkMemory(const void *memory, size_t bytes, size_t needed, size_t alignment, const char *what,
                        sphc_message *message);
// What the library writes to must not be read as something else.
struct MemoryRange {
  const char *name;
  const void *begin;
  size_t bytes;
};
sphc_status checkApart(const MemoryRange &written, const MemoryRange &other, sphc_message *message);
// Is it apart from the maps: their views, their files and the list of them?
sphc_status checkApartFromMaps(const MemoryRange &written, const sphc_map *const *maps, uint32_t map_count,
                               sphc_message *message);

}  // namespace sphc
