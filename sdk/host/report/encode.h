// Putting bytes and text into a web page.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::host {

std::string base64(const std::vector<uint8_t> &bytes);
// & < > " ' made harmless.
std::string escapeHtml(const std::string &text);
// Several SVG drawings in one page must not share ids: every id and every reference to one gets the prefix.  What
// stands before the <svg> element (XML declaration) is cut off.
std::string inlineSvg(const std::string &svg, const std::string &prefix);

}  // namespace sphc::host
