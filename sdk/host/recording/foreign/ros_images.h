// Images of ROS's messages: raw, JPEG, PNG, compressedDepth.
#pragma once

#include <spherecloud/spherecloud.h>

#include "host/recording/foreign/ros_messages.h"
#include "host/recording/image_header.h"

namespace sphc::recording {

// Each fills `pixels` with an image of the camera's size.  Throw Failure without a name: DEVICE when the message is
// malformed, IMAGE when the image does not fit the calibration, UNSUPPORTED for an encoding that is not read.
// Depth becomes DEPTH16 in millimetres, whatever it was in.
void decodeRosColor(const RosMessage &message, bool is_compressed, const sphc_camera &camera, sphc_format format,
                    uint8_t *pixels);
void decodeRosDepth(const RosMessage &message, bool is_compressed, const sphc_camera &camera, uint16_t *depth_mm);

// Whether raw images of this encoding can be colour.
bool isReadRosColor(std::string_view encoding);
// 16UC1 or mono16: the encoding of raw images, or that of which the format of compressed ones says they were made.
bool isRos16Bit(std::string_view format);
// Whether twelve bytes come before the image.
bool isCompressedDepth(std::string_view format);

// What is read, for refusals.
constexpr const char *kReadRosColor = "rgb8, bgr8, rgba8, bgra8, mono8, JPEG and PNG are read: record such a topic";
constexpr const char *kReadRosDepth = "16UC1, mono16 and 32FC1 are read: record such a topic";

// As its head tells; 0 x 0 where that cannot be read.
ImageSize rosImageSize(const RosCompressedImage &image);

// Metres as millimetres; 0 for what is no measurement or beyond 65 m.
uint16_t millimetresOf(float depth_m);

}  // namespace sphc::recording
