// font.h - capital letters and digits of 5 x 7 dots.
#pragma once

namespace sphc::simulated {

constexpr int kFontColumns = 5;
constexpr int kFontRows = 7;

// Whether a letter has ink at a dot; other characters are blank.
bool fontDot(char letter, int column, int row);

}  // namespace sphc::simulated
