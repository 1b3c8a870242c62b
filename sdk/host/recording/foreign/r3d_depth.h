// Images of depth and confidence in Record3D's own form: floats in metres, or bytes, compressed by LZFSE.
#pragma once

#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/image_header.h"
#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// The size of the depth image in a file: as the metadata tells it, or of the colour image's shape.  Throws Failure
// (DEVICE) without a name, as all of these do; IMAGE when an image is not of the camera's size.
ImageSize r3dDepthSizeOf(ByteView file, const Record3dMetadata &metadata);
void decodeR3dDepth(ByteView file, const sphc_camera &camera, uint16_t *depth_mm);
// A byte a pixel, as ARKit's: 0 low, 1 medium, 2 high.
void decodeR3dConfidence(ByteView file, const sphc_camera &camera, Bytes &confidence);

}  // namespace sphc::recording
