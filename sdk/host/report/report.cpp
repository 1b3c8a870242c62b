#include "host/report/report.h"

#include <filesystem>

#include "host/base/write_file.h"
#include "host/report/direction_picture.h"
#include "host/report/encode.h"
#include "host/report/file.h"
#include "host/report/json.h"
#include "host/report/overlay.h"
#include "host/report/page.h"
#include "host/report/picture_bytes.h"
#include "host/report/plots.h"
#include "host/report/reliability_plot.h"
#include "host/report/top_view.h"
#include "host/report/trajectory.h"

namespace sphc::host {
namespace {

constexpr uint32_t kOverlayQuality = 88;  // of JPEG

std::string textOf(const std::string &path) {
  const auto bytes = readBytes(path);
  return {bytes.begin(), bytes.end()};
}

void addOverlays(const std::string &folder, const Run &run, const ImageOfFrame &image_of_frame,
                 PageContent *content) {
  for (const Highlight &highlight : chooseHighlights(run)) {
    const FrameRecord &frame = run.frames[highlight.frame];
    const cv::Mat color = image_of_frame ? image_of_frame(frame) : cv::Mat();
    if (color.empty()) continue;
    PagePicture picture;
    picture.title = highlight.title;
    picture.caption =
        "Frame " + std::to_string(frame.sequence) + ": " +
        (frame.localized
             ? std::to_string(frame.inliers) + " of " + std::to_string(frame.matches) + " matches agree."
             : std::string(outcomeName(frame.outcome)) + ", " + outcomeAdvice(frame.outcome) + ".");
    picture.mime = "image/jpeg";
    picture.encoded = jpegOf(drawOverlay(color, frame), kOverlayQuality);
    writeFile(folder + "/overlay_" + highlight.name + ".jpg", picture.encoded);
    content->overlays.push_back(std::move(picture));
  }
}

void addPlots(const std::string &folder, const Run &run, const Summary &summary, PageContent *content) {
  const std::string plots = folder + "/plots";
  makeFolder(plots);
  std::filesystem::remove(plots + "/gnuplot.log");
  const std::vector<Drawing> drawings = {pathFromTop(run), stageTimes(summary), translationCdf(run),
                                         rotationCdf(run), reliability(run),    timeline(run)};
  for (const Drawing &drawing : drawings) removePlot(plots, drawing.name);  // of another run
  for (const Drawing &drawing : drawings) {
    if (drawing.script.empty()) continue;
    const PlotResult result = plot(plots, drawing.name, drawing.script, drawing.size);
    if (result == PlotResult::kNoGnuplot) {
      content->plot_problem =
          "The plots are missing because gnuplot is not installed. Install it (apt-get install "
          "gnuplot-nox) and run the same command again, or run gnuplot on the scripts in plots/.";
      continue;  // their scripts are written
    }
    if (result == PlotResult::kFailed) {
      content->plot_problem = "gnuplot could not draw " + drawing.name + "; plots/gnuplot.log says why.";
      continue;
    }
    PagePicture picture;
    picture.title = drawing.title;
    picture.caption = drawing.caption;
    picture.wide = drawing.size.width_px > 1000;
    picture.svg = inlineSvg(textOf(plots + "/" + drawing.name + ".svg"), drawing.name + "-");
    content->plots.push_back(std::move(picture));
  }
}

// The map's axes are those of the recording's world, which may lie any way; turn the sky upright.
std::vector<std::array<double, 3>> uprightDirections(const MapFacts &map, const TopView &view) {
  const auto &r = view.right, &u = view.up;
  const double sky[3] = {r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]};
  std::vector<std::array<double, 3>> upright;
  for (const auto &d : map.directions) {
    const auto flat = view.project(d.data());
    upright.push_back({flat[0], flat[1], sky[0] * d[0] + sky[1] * d[1] + sky[2] * d[2]});
  }
  return upright;
}

// Each map may have axes of its own.
TopView viewOfAnswers(const Run &run, uint32_t map) {
  std::vector<sphc_rigid> poses;
  for (const FrameRecord &frame : run.frames) {
    if (frame.localized && frame.map == map) poses.push_back(frame.base_from_camera);
  }
  return topView(poses);
}

void addDirections(const std::string &folder, const Run &run, PageContent *content) {
  const uint32_t map = mapOfMostAnswers(run);
  content->directions.title = run.maps.size() > 1 ? "All that " + run.maps[map].path + " shows of its room"
                                                  : std::string("All that the map shows of the room");
  content->directions.mime = "image/png";
  double peak_upright = 0;
  const TopView view = viewOfAnswers(run, map);
  content->is_up_an_axis = view.is_up_an_axis;
  const bool is_turned = view.right != TopView().right || view.up != TopView().up;
  const cv::Mat picture = drawDirections(uprightDirections(run.maps[map], view), &peak_upright,
                                         is_turned ? Longitudes::kBare : Longitudes::kNumbered);
  // Pixels of other axes count a little otherwise; the number that is told is that of `inspect`.
  drawDirections(run.maps[map].directions, &content->direction_peak);
  content->directions.encoded = pngOf(picture);
  writeFile(folder + "/map_directions.png", content->directions.encoded);
}

// By it the next run knows the folder, should this one end before its page is written.  The page of an earlier run
// must not stay either: what lies beside it is no longer its own.
void writeUnfinishedPage(const std::string &page) {
  writeFile(page,
            std::string("<!doctype html>\n<html lang='en'><head><meta charset='utf-8'>") + kReportHead +
                "</head>\n<body><p>This report was not finished. Run the same command again.</p></body></html>\n");
}

// Another run had other frames to show; its pictures must not stay beside this one's.
void removeOldOverlays(const std::string &folder) {
  std::vector<std::filesystem::path> old;
  for (const auto &entry : std::filesystem::directory_iterator(folder)) {
    if (isOverlayFile(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const auto &path : old) std::filesystem::remove(path);
}

}  // namespace

ReportSummary writeReport(const std::string &folder, const Run &run, const ImageOfFrame &image_of_frame) {
  if (run.base != "world")
    makeFolder(folder);
  else
    makePrivateFolder(folder);  // drawings show the sphere centres
  const std::string page = folder + "/report.html";
  writeUnfinishedPage(page);
  removeOldOverlays(folder);
  const Summary summary = summarize(run);
  PageContent content;
  addOverlays(folder, run, image_of_frame, &content);
  addPlots(folder, run, summary, &content);
  addDirections(folder, run, &content);
  writeFile(folder + "/frames.jsonl", framesJsonLines(run));
  writeFile(folder + "/summary.json", jsonText(summaryJson(run, summary), 2) + "\n");
  writeFile(folder + "/trajectory.tum", tumTrajectory(run));
  writeFile(page, reportPage(run, summary, content));
  return {page, content.plot_problem};
}

}  // namespace sphc::host
