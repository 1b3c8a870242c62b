// Knobs of a camera: exposure, gain, power line frequency ...
#pragma once

#include "node.h"
#include "v4l2.h"

namespace sphc::v4l2 {

sphc_status listControls(const Node &node, sphc_v4l2_control *controls, uint32_t capacity, uint32_t *count,
                         sphc_message *message);
sphc_status findControl(const Node &node, const char *name, sphc_v4l2_control *control, sphc_message *message);
sphc_status getControl(const Node &node, uint32_t id, int64_t *value, sphc_message *message);
sphc_status setControl(const Node &node, uint32_t id, int64_t value, sphc_message *message);

// Of the frames to come; 0 when the camera chooses it itself, or does not say.
uint32_t readExposureUs(const Node &node);
// Asks for news of exposure, and of a source that changes its size.  A device without events is fine.
void subscribeEvents(const Node &node);
// Takes what news there is.
struct News {
  int error;  // of the device: ENODEV
  bool exposure_changed, source_changed;
};
News readNews(const Node &node);

}  // namespace sphc::v4l2
