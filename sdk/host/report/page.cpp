#include "host/report/page.h"

#include <algorithm>
#include <cmath>

#include "host/base/counted.h"
#include "host/base/listed.h"
#include "host/report/encode.h"
#include "host/report/page_style.h"
#include "host/report/table.h"
#include "host/report/truth_words.h"

namespace sphc::host {

const char kReportHead[] = "<title>SphereCloud report</title>";

namespace {

std::string card(const std::string &value, const std::string &name, const std::string &grade = "") {
  return "<div class='card " + grade + "'><b>" + escapeHtml(value) + "</b><span>" + escapeHtml(name) +
         "</span></div>\n";
}

// Traffic-light border of a card: value at least `good`, at least `fair`, or below.
std::string grade(double value, double good, double fair) {
  return value >= good ? "good" : value >= fair ? "fair" : "bad";
}

std::string cards(const Run &run, const Summary &s) {
  const double localized = percent(s.localized, s.frames);
  std::string html =
      "<div class='cards'>\n" +
      card(fixed(localized, 1) + " %", "of " + counted(s.frames, "frame") + " localized", grade(localized, 90, 60));
  if (s.with_truth) {
    const double good = percent(s.good, s.with_truth);
    html += card(fixed(good, 1) + " %", "within 5 cm and 5°", grade(good, 90, 60));
  }
  if (!std::isnan(s.translation_m.median)) {
    html += card(fixed(100 * s.translation_m.median, 2) + " cm", "median distance from the truth",
                 grade(-s.translation_m.median, -0.02, -0.05));
    html += card(fixed(s.rotation_deg.median, 2) + "°", "median rotation error",
                 grade(-s.rotation_deg.median, -0.5, -2));
  }
  if (!std::isnan(s.stage_median_ms[kTotal]))
    html += card(fixed(s.stage_median_ms[kTotal], 1) + " ms", "a frame, median");
  const double memory = static_cast<double>(run.state_bytes + run.scratch_bytes + mapBytes(run));
  return html + card(humanBytes(memory), "of device memory, map included") + "</div>\n";
}

std::string figure(const PagePicture &picture) {
  std::string html = std::string("<figure") + (picture.wide ? " class='wide'" : "") + "><h3>" +
                     escapeHtml(picture.title) + "</h3>";
  if (!picture.svg.empty())
    html += picture.svg;
  else
    html += "<img tabindex='0' alt='" + escapeHtml(picture.title) + "' src='data:" + picture.mime + ";base64," +
            base64(picture.encoded) + "'>";
  return html + "<figcaption>" + escapeHtml(picture.caption) + "</figcaption></figure>\n";
}

std::string figures(const std::vector<PagePicture> &pictures, const std::string &kind = "") {
  std::string html = "<div class='pictures " + kind + "'>\n";
  for (const PagePicture &picture : pictures) html += figure(picture);
  return html + "</div>\n";
}

std::string section(const std::string &title, const std::string &body) {
  return "<section><h2>" + escapeHtml(title) + "</h2>\n" + body + "</section>\n";
}

std::string tableOf(const std::vector<Row> &rows) {
  std::string html = "<table><tbody>\n";
  for (const Row &row : rows) {
    html += "<tr><td>" + escapeHtml(row.name) + "</td><td class='value'>" + escapeHtml(row.value) +
            "</td><td class='soft'>" + escapeHtml(row.note) + "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

const char kHowToRead[] = R"(<p>Each frame of the recording, a colour and a depth image, was given to the localizer
together with the map. It answered where the camera was, or that it cannot tell.</p>
<p class='soft'>The map is a <b>sphere cloud</b>: of every point it keeps only the direction from one centre, hidden
among fake directions. It holds no point's place in the room, and still a camera that measures depth finds its place in
it: the depths come from the camera, not from the map.</p>)";
const char kNoTruth[] =
    R"(<p class='warn'>The truth was not given, so this report cannot say how exact the answers are.
Run again with <code>--owner-note</code> on a recording that has poses.</p>)";

std::string withoutTruth(const Run &run) {
  if (run.base == "map") return kNoTruth;
  return std::string("<p class='warn'>") +
         (run.has_poses ? "No pose of the recording can be compared" : "The recording holds no poses") +
         ", so this report cannot say how exact the answers are.\n"
         "It needs a recording with poses at the times of its images.</p>";
}

std::string howToRead(const Run &run, const Summary &s) {
  if (s.with_truth) return kHowToRead;
  return kHowToRead + withoutTruth(run);
}

constexpr uint32_t kWorstShown = 8, kMostWrongShown = 50;

std::string warningOf(const Summary &s) {
  if (!s.wrong) return "";
  return "<p class='wrong'><b>" + std::to_string(s.wrong) +
         (s.wrong == 1 ? " wrong pose was" : " wrong poses were") +
         " given out</b>: further than 25 cm or 10 degrees from the truth. The list \"Worst poses\" below has " +
         (s.wrong > kMostWrongShown ? "the worst " + std::to_string(kMostWrongShown) + "; frames.jsonl has all"
                                    : std::string("them")) +
         ".</p>\n";
}

// Else the errors seem to be the localizer's alone.
std::string truthNotes(const Run &run, const Summary &s) {
  std::string html;
  if (const std::string words = alignmentWords(run); !words.empty())
    html += "<p class='warn'><b>Truth aligned</b> by " + counted(run.aligned_frames, "pose") + ": " +
            escapeHtml(words) + ".</p>\n";
  if (const std::string doubt = doubtOfTruth(run, s); !doubt.empty())
    html += "<p class='warn'>" + escapeHtml(doubt) + ".</p>\n";
  return html;
}

// The poses furthest from the truth, with what the localizer said of them.
std::string worstPosesTable(const Run &run, const Summary &s) {
  std::string html =
      "<table><thead><tr><th>frame</th><th>off</th><th></th><th>stated "
      "sigma</th><th>confidence</th><th>inliers</th>"
      "</tr></thead><tbody>\n";
  const std::vector<size_t> worst = worstFrames(run, std::clamp(s.wrong, kWorstShown, kMostWrongShown));
  for (size_t index : worst) {
    const FrameRecord &frame = run.frames[index];
    html += std::string("<tr") + (isWrong(frame) ? " class='wrong'" : "") + "><td>" +
            std::to_string(frame.sequence) + "</td><td class='value'>" + fixed(100 * frame.translation_error_m, 1) +
            " cm</td><td class='value'>" + fixed(frame.rotation_error_deg, 2) + "°</td><td class='value'>" +
            fixed(100 * frame.sigma_translation_m, 1) + " cm, " + fixed(frame.sigma_rotation_deg, 2) +
            "°</td><td class='value'>" + (frame.confidence ? fixed(*frame.confidence, 2) : "") +
            "</td><td class='value'>" + std::to_string(frame.inliers) + "</td></tr>\n";
  }
  return worst.empty() ? "" : html + "</tbody></table>\n";
}

const char kOverlayIntro[] = R"(<p class='soft'>
<span class='key' style='border-color:#a3a3a3'></span>keypoint &nbsp;
<span class='key' style='border-color:#f59e0b'></span>looks like a point of the map but does not fit the pose
(often a fake point: they carry real descriptors) &nbsp;
<span class='key' style='border-color:#22c55e'></span>fits the pose.
Green rings spread over the whole image pin the pose down best. Click a picture to enlarge it.</p>)";

std::string outcomeTable(const Summary &s) {
  std::vector<Row> rows;
  for (size_t i = 0; i < s.outcomes.size(); ++i) {
    const auto outcome = static_cast<sphc_localizer_outcome>(i);
    if (s.outcomes[i] || i == 0)
      rows.push_back({outcomeName(outcome), std::to_string(s.outcomes[i]), outcomeAdvice(outcome)});
  }
  return tableOf(rows);
}

// Pieces of one name are one row, largest first.
std::vector<std::pair<MemoryPiece, size_t>> gatherPieces(const Run &run) {
  std::vector<std::pair<MemoryPiece, size_t>> gathered;
  for (const MemoryPiece &piece : run.memory) {
    const auto same = std::find_if(gathered.begin(), gathered.end(), [&piece](const auto &known) {
      return known.first.name == piece.name && known.first.scratch == piece.scratch;
    });
    if (same == gathered.end()) {
      gathered.emplace_back(piece, 1);
      continue;
    }
    same->first.bytes += piece.bytes;
    ++same->second;
  }
  std::stable_sort(gathered.begin(), gathered.end(),
                   [](const auto &a, const auto &b) { return a.first.bytes > b.first.bytes; });
  return gathered;
}

std::string memoryTable(const Run &run) {
  constexpr size_t kShown = 9;
  std::vector<Row> rows = {{run.maps.size() > 1 ? "map files" : "map file",
                            humanBytes(static_cast<double>(mapBytes(run))), "read-only, used in place"}};
  const auto pieces = gatherPieces(run);
  size_t rest = 0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const auto &[piece, count] = pieces[i];
    if (i >= kShown) {
      rest += piece.bytes;
      continue;
    }
    rows.push_back({piece.name + (count > 1 ? " × " + std::to_string(count) : ""),
                    humanBytes(static_cast<double>(piece.bytes)), piece.scratch ? "scratch" : "state"});
  }
  if (rest) rows.push_back({"everything else", humanBytes(static_cast<double>(rest)), ""});
  return tableOf(rows);
}

std::string settingsTable(const Run &run) {
  std::vector<Row> rows;
  for (const Setting &setting : run.settings) rows.push_back({setting.name, setting.value, ""});
  return tableOf(rows);
}

std::string mapSection(const Run &run, const PageContent &content) {
  std::vector<Row> rows;
  const std::vector<size_t> answers = answersByMap(run);
  for (size_t i = 0; i < run.maps.size(); ++i) {
    const MapFacts &map = run.maps[i];
    if (run.maps.size() > 1) rows.push_back({"map", map.path, counted(answers[i], "frame") + " localized in it"});
    rows.push_back({"points, real and fake", std::to_string(map.points), "the file does not tell them apart"});
    rows.push_back({"bytes", humanBytes(static_cast<double>(map.file_bytes)), ""});
    rows.push_back({"map id", map.id.substr(0, 12) + "…", "name of this release, by what it holds"});
    rows.push_back({"format version", std::to_string(map.format_version), ""});
    rows.push_back({"extractor", std::to_string(map.extractor), "what described the points"});
    rows.push_back({"band", bandName(map.band), "the light of its images"});
  }
  PagePicture picture = content.directions;
  picture.caption =
      "All directions in " + (run.maps.size() > 1 ? run.maps[mapOfMostAnswers(run)].path : std::string("the map")) +
      ", seen from its centre, as a map of the sky: longitude to the left, " +
      (content.is_up_an_axis ? "up is up" : "up is as the cameras were held on average") +
      ". The brightest spot is " + fixed(content.direction_peak, 1) + " times denser than an even spread.";
  return "<div class='columns' style='align-items:center'>" + figure(picture) + "<div>" + tableOf(rows) +
         "</div></div>";
}

std::string nameOfMaps(const Run &run) {
  std::vector<std::string> paths;
  for (const MapFacts &map : run.maps) paths.push_back(map.path);
  return (paths.size() > 1 ? "the sphere clouds " : "the sphere cloud ") + listed(paths);
}

std::string plotSection(const PageContent &content) {
  std::string body;
  if (!content.plot_problem.empty()) body += "<p class='warn'>" + escapeHtml(content.plot_problem) + "</p>";
  return body + (content.plots.empty() ? "" : figures(content.plots));
}

}  // namespace

std::string reportPage(const Run &run, const Summary &s, const PageContent &content) {
  std::string html =
      "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'>"
      "<meta name='viewport' content='width=device-width,initial-scale=1'>" +
      std::string(kReportHead) + "<style>" + kPageStyle + "</style></head>\n<body>\n";
  html += "<header><div><h1>Where was the camera?</h1><p>" + escapeHtml(run.recording) + " in " +
          escapeHtml(nameOfMaps(run)) + "</p></div></header>\n<main>\n";
  html += cards(run, s) + warningOf(s) + truthNotes(run, s);
  html += section("What you are looking at", howToRead(run, s));
  html += section("In pictures", plotSection(content));
  if (!content.overlays.empty())
    html += section("What the camera saw", kOverlayIntro + figures(content.overlays, "overlays"));
  if (const std::string worst = worstPosesTable(run, s); !worst.empty()) html += section("Worst poses", worst);
  html += section("Figures", tableOf(tableRows(run, s)) +
                                 "<div class='columns'><div><h3>What became of the frames</h3>" + outcomeTable(s) +
                                 "</div><div><h3>Where the bytes go</h3>" + memoryTable(run) + "</div></div>");
  html += section("The map", mapSection(run, content));
  html += section("Settings", settingsTable(run));
  return html + "<footer>Made by spherecloud " + sphc_version_string() +
         ". The plots lie beside this page in plots/, with the "
         "gnuplot scripts that drew them; per-frame figures in frames.jsonl.</footer>\n</main></body></html>\n";
}

}  // namespace sphc::host
