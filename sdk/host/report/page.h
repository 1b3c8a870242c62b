// The report's web page: one file that needs nothing else.
#pragma once
#include <string>
#include <vector>

#include "host/report/statistics.h"

namespace sphc::host {

// A picture of the page: an SVG drawing, or an encoded image.
struct PagePicture {
  std::string title, caption;
  std::string svg;               // inline, ids already made unique
  std::vector<uint8_t> encoded;  // else: JPEG or PNG
  std::string mime;              // of `encoded`
  bool wide = false;             // a row of its own
};

struct PageContent {
  std::vector<PagePicture> overlays, plots;
  PagePicture directions;
  double direction_peak = 0;
  bool is_up_an_axis = true;  // of the base, in the picture of directions
  std::string plot_problem;   // why plots are missing, and the cure; empty when they are there
};

// Near the beginning of every page that is written here.
extern const char kReportHead[];

std::string reportPage(const Run &run, const Summary &summary, const PageContent &content);

}  // namespace sphc::host
