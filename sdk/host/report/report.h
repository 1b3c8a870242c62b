// Writes a folder that a person looks at after a run.
//
//     FOLDER/report.html              all of it on one page that needs nothing else
//     FOLDER/overlay_best.jpg, ...    single frames
//     FOLDER/map_directions.png       where the map's directions point
//     FOLDER/plots/NAME.{svg,png,gp}  drawings and the gnuplot scripts behind them
//     FOLDER/frames.jsonl, summary.json, trajectory.tum
#pragma once
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "host/report/run.h"

namespace sphc::host {

// The colour image (8-bit BGR) of a frame; empty when it cannot be read any more.
using ImageOfFrame = std::function<cv::Mat(const FrameRecord &frame)>;

struct ReportSummary {
  std::string page;     // path of report.html
  std::string problem;  // what is missing and how to get it; empty when nothing is
};

// Files of an earlier report in the folder are replaced.  Throws std::runtime_error when it cannot be written.
ReportSummary writeReport(const std::string &folder, const Run &run, const ImageOfFrame &image_of_frame);

}  // namespace sphc::host
