#include "drivers/simulated/menu.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "drivers/simulated/font.h"

namespace sphc::simulated {
namespace {

constexpr int kDotPx = 3, kMarginPx = 3, kGapPx = 2;
constexpr int kHeightPx = kFontRows * kDotPx + 2 * kMarginPx;

struct Tone {
  uint8_t r, g, b;
};
constexpr Tone kInkLight = {255, 255, 255}, kInkDark = {0, 0, 0}, kPaperDark = {40, 40, 40};
// The words are of different lengths and the buttons of different tones, as menus are.
constexpr struct {
  const char *word;
  Tone tone;
} kButtons[] = {{"MESSAGES", {214, 160, 92}}, {"SETTINGS", {96, 190, 235}}, {"MAP 2", {120, 220, 130}},
                {"HELP ME", {235, 120, 150}}, {"QUIT NOW", {200, 200, 90}}, {"SHARE IT", {150, 130, 230}}};

struct Image {
  uint8_t *rgb;
  uint32_t width;
};

void fillBox(int left, int top, int width, int height, const Tone &tone, const Image &image) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) {
      uint8_t *pixel = image.rgb + 3 * (static_cast<size_t>(y) * image.width + static_cast<size_t>(x));
      pixel[0] = tone.r;
      pixel[1] = tone.g;
      pixel[2] = tone.b;
    }
}

int widthOf(const std::string &text) {
  return static_cast<int>(text.size()) * (kFontColumns + 1) * kDotPx + 2 * kMarginPx;
}

void drawButton(int left, int top, int width, const std::string &text, const Tone &paper, const Tone &ink,
                const Image &image) {
  fillBox(left, top, width, kHeightPx, paper, image);
  for (size_t i = 0; i < text.size(); ++i)
    for (int row = 0; row < kFontRows; ++row)
      for (int column = 0; column < kFontColumns; ++column) {
        const int x = left + kMarginPx + (static_cast<int>(i) * (kFontColumns + 1) + column) * kDotPx;
        if (fontDot(text[i], column, row)) fillBox(x, top + kMarginPx + row * kDotPx, kDotPx, kDotPx, ink, image);
      }
}

std::string twoDigits(int number) { return std::to_string(number / 10 % 10) + std::to_string(number % 10); }

}  // namespace

void drawMenu(double time_s, uint32_t image_width, uint32_t image_height, uint8_t *rgb) {
  const Image image = {rgb, image_width};
  const auto seconds = static_cast<int>(time_s);
  const std::string line = "CAM 04 REC " + twoDigits(seconds / 60) + " " + twoDigits(seconds % 60);
  drawButton(10, 10, widthOf(line), line, kPaperDark, kInkLight, image);
  int width = 0;
  for (const auto &button : kButtons) width = std::max(width, widthOf(button.word));
  const int count = static_cast<int>(std::size(kButtons));
  const int left = static_cast<int>(image_width) - width - 20;
  int top = static_cast<int>(image_height) - count * (kHeightPx + kGapPx) - 10;
  for (const auto &button : kButtons) {
    drawButton(left, top, width, button.word, button.tone, kInkDark, image);
    top += kHeightPx + kGapPx;
  }
}

}  // namespace sphc::simulated
