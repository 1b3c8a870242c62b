#include <stdexcept>

#include "drivers/v4l2/v4l2.h"
#include "live_drivers.h"
#include "recorded.h"

namespace sphc::guest {

LiveSource openV4l2(const std::string &node, sphc_stream stream) {
  const bool is_depth = stream == SPHC_STREAM_DEPTH;
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = stream;
  config.format = is_depth ? SPHC_FORMAT_DEPTH16 : SPHC_FORMAT_BGR8;
  config.width = is_depth ? kDepthWidth : kColorWidth;
  config.height = is_depth ? kDepthHeight : kColorHeight;
  config.fps = 0;
  sphc_message message = {};
  sphc_v4l2 *camera = nullptr;
  if (sphc_v4l2_open(node.c_str(), &config, &camera, &message) != SPHC_OK) throw std::runtime_error(message.text);
  LiveSource live{{}, {camera, [](sphc_v4l2 *closing) { sphc_v4l2_close(&closing); }}};
  sphc_v4l2_source(camera, &live.source);
  return live;
}

}  // namespace sphc::guest
