// Depth images in OpenEXR, as floats in metres.
#pragma once

#include <spherecloud/spherecloud.h>

#include "host/recording/image_header.h"

namespace sphc::recording {

// By its header alone.  Throws Failure (DEVICE) without a name, UNSUPPORTED in a build without OpenEXR.
ImageSize exrSizeOf(ByteView file);

// Fills an image of the camera's size with millimetres; 0 for what is no measurement.  The channel is R or the only
// one.  Throws Failure without a name: DEVICE when it cannot be decoded, IMAGE when it does not fit the
// calibration.
void decodeExrDepth(ByteView file, const sphc_camera &camera, uint16_t *depth_mm);

}  // namespace sphc::recording
