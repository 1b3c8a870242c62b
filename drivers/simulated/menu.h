// menu.h - what a program draws over the colour image of a recording: a line of text and a menu, which stay where
// they are in the image.
#pragma once

#include <cstdint>

namespace sphc::simulated {

// `rgb` is the tightly packed image of the colour camera, `time_s` what the line of text tells.
void drawMenu(double time_s, uint32_t width, uint32_t height, uint8_t *rgb);

}  // namespace sphc::simulated
