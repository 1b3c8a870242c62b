// One interleaved run of all aligners over the frames of a case, and what it shows.
#pragma once
#include <functional>
#include <nlohmann/json.hpp>

#include "lab/align/variant.h"

namespace sphc::host {

struct AlignRow {
  std::string name;
  double median_ms = 0, p99_ms = 0;
  double times_slower = 0;                              // than ours, ratio of the medians
  double with_depth_percent = 0, occluded_percent = 0;  // of the colour image; occluded NaN where none is told
  double edge_median_px = 0;                            // from depth edges to image edges
};

struct AlignTable {
  std::string name;
  size_t frames = 0;
  double edge_before_px = 0;  // of the depth image as it is, laid over the colour image
  double sparse_median_ms = 0, sparse_p99_ms = 0, lifted_mean = 0;  // of 800 keypoints
  std::vector<AlignRow> rows;
};

using FrameDone = std::function<void(uint32_t done, uint32_t total)>;
// Absent variants are left out.  Every frame goes through every variant `repeats` times, in turn; the median
// counts.
AlignTable runAlignBench(const AlignCase &c, const std::vector<AlignVariant> &variants, uint32_t repeats,
                         const FrameDone &done);

std::string alignText(const AlignTable &table);
// No milliseconds, which are of one machine.
std::string alignResults(const std::vector<AlignTable> &tables);
nlohmann::ordered_json alignJson(const std::vector<AlignTable> &tables);

// The depth image enlarged to the colour image's size, nothing else.
std::vector<uint16_t> laidOver(const AlignCase &c, const AlignFrame &frame);

// Depth edges over the grey image before and after, and the mask, side by side, of the first frame.  Throws
// std::runtime_error when the file cannot be written.
void writeAlignPicture(const AlignCase &c, const std::string &path);

}  // namespace sphc::host
