#include "host/guide/advice.h"

#include <algorithm>

namespace sphc::host {

const std::array<BitWords, 6> kAdviceWords = {{
    {kGoBack, "lost", "go back"},
    {kMoreLight, "too dark", "more light"},
    {kOtherRange, "no depth", "step back or closer; glass and black things have no depth"},
    {kSlower, "too fast", "slower"},
    {kMoreTexture, "too plain", "look at something with more texture"},
    {kLookAgain, "thin", "look at this corner again, from elsewhere"},
}};

const BitWords &wordsOf(GuideAdvice bit) {
  return *std::find_if(kAdviceWords.begin(), kAdviceWords.end(),
                       [&](const BitWords &words) { return words.bit == bit; });
}

GuideAdvice adviceOf(Hints hints) {
  GuideAdvice advice = 0;
  if (hints & kTooDark) advice |= kMoreLight;
  if (hints & kTooFast) advice |= kSlower;
  if (hints & kTooPlain) advice |= kMoreTexture;
  if (hints & kNoDepthInRange) advice |= kOtherRange;
  return advice;
}

}  // namespace sphc::host
