// The image in a message of an MCAP recording, decoded into memory that is there already.
#pragma once

#include "host/recording/mcap/depth_zstd.h"
#include "host/recording/mcap/messages.h"

namespace sphc::recording {

class MessageDecoder {
 public:
  // Fills `pixels` with an image of the camera's size: DEPTH16, GRAY16 of amplitudes, or colour in `format`. Throws
  // Failure without a name: DEVICE when the message is malformed, IMAGE when the image does not fit the
  // calibration.
  void decode(Kind kind, ByteView message, const sphc_camera &camera, sphc_format format, uint8_t *pixels);

 private:
  void decodeRaw(ByteView message, const sphc_camera &camera, sphc_format format, uint8_t *pixels);
  void decodeDepth(Kind kind, ByteView data, const sphc_camera &camera, uint8_t *pixels);

  DepthZstdDecoder zstd_;
};

}  // namespace sphc::recording
