// Images in memory: what fits, and from one pixel format to another.
#pragma once

#include <spherecloud/spherecloud.h>

#include <string>

namespace sphc::recording {

// Whether recordings have images of this format: GRAY8, RGB8, BGR8 and DEPTH16.
bool isRecorded(sphc_format format);

size_t packedBytes(const sphc_image &image);

// "640 x 480"
std::string sizeText(uint32_t width, uint32_t height);

// Throws Failure (IMAGE) unless the image is a valid one of its stream and of the camera's size.
void checkImage(const sphc_image &image, const sphc_camera &camera, bool is_color);

// The same of a depth capture's amplitude image.
void checkAmplitude(const sphc_image &image, const sphc_camera &depth_camera);

// Amplitudes as GRAY16, rows without padding; numbers stay what they are.
void packAmplitude(const sphc_image &image, uint16_t *out);

// Rows without padding.  `to` is the image's own format, or both are of colour; grey is what OpenCV makes of
// colour.
void packPixels(const sphc_image &image, sphc_format to, uint8_t *out);

}  // namespace sphc::recording
