#include "host/cli/audit_page.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "host/report/encode.h"
#include "host/report/file.h"
#include "host/report/page_style.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

constexpr size_t kPictured = 6;  // views
constexpr int kLabel = 190, kBorder = 2;

// Brought to one brightness and contrast, since networks paint in no unit.
cv::Mat shown(const cv::Mat &grey, const cv::Mat &mask) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation, mask);
  const double gain = 55 / std::max(deviation[0], 1e-6);
  cv::Mat bytes, framed;
  grey.convertTo(bytes, CV_8U, gain, 120 - gain * mean[0]);
  if (!mask.empty()) bytes.setTo(90, mask == 0);
  cv::copyMakeBorder(bytes, framed, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT, cv::Scalar(255));
  return framed;
}

// A label and some pictures.
cv::Mat strip(const std::string &name, const std::vector<cv::Mat> &pictures) {
  cv::Mat row(pictures.front().rows, kLabel, CV_8U, cv::Scalar(255));
  cv::putText(row, name, {6, row.rows / 2}, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar(0), 1, cv::LINE_AA);
  for (const cv::Mat &picture : pictures) cv::hconcat(row, picture, row);
  return row;
}

cv::Mat sheetOf(const MapAudit &audit) {
  std::vector<size_t> chosen;
  for (size_t k = 0; k < std::min(kPictured, audit.views.size()); ++k)
    chosen.push_back(k * audit.views.size() / std::min(kPictured, audit.views.size()));
  if (chosen.empty()) return {};
  std::vector<cv::Mat> truth;
  for (size_t i : chosen) truth.push_back(shown(audit.views[i].truth.grey, audit.views[i].truth.seen));
  cv::Mat sheet = strip("truth", truth);
  for (const InversionResult &result : audit.inversions) {
    std::vector<cv::Mat> pictures;
    for (size_t i : chosen) pictures.push_back(shown(result.pictures[i], {}));
    cv::vconcat(sheet, strip(result.name, pictures), sheet);
  }
  return sheet;
}

std::string cell(const std::string &text) { return "<td>" + escapeHtml(text) + "</td>"; }

std::string figuresTable(const MapAudit &audit) {
  std::string html =
      "<table><thead><tr><th>Figure</th><th>Value</th><th>Limit</th><th>Verdict</th><th></th></tr></thead>";
  for (const AuditFigure &figure : audit.figures) {
    html += "<tr>" + cell(figure.about) + "<td class=value>" + (figure.value ? fixed(*figure.value, 3) : "-") +
            (figure.standard_error > 0 ? " &plusmn; " + fixed(figure.standard_error, 3) : "") + "</td>" +
            cell(figure.limit ? (figure.at_most ? "at most " : "at least ") + fixed(*figure.limit, 3) : "") +
            cell(wordFor(figure.verdict())) + "<td class=soft>" + escapeHtml(figure.remark) + " <code>" +
            escapeHtml(figure.name) + "</code></td></tr>";
  }
  return html + "</table>";
}

std::string retrievalTable(const MapAudit &audit) {
  std::string html = "<table><thead><tr><th>Points</th><th>Places told, coarse</th><th>fine</th></tr></thead>";
  for (const InversionResult &result : audit.inversions) {
    const auto text = [](const Retrieval &r) {
      return fixed(r.top1, 2) + " &plusmn; " + fixed(r.standard_error, 2);
    };
    html += "<tr>" + cell(result.name) + "<td class=value>" + text(result.coarse) + "</td><td class=value>" +
            text(result.fine) + "</td></tr>";
  }
  return html + "</table>";
}

}  // namespace

std::string wordFor(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return "holds";
    case Verdict::kBroken:
      return "BROKEN";
    case Verdict::kInformation:
      return "for information";
    case Verdict::kNotMeasured:
      break;
  }
  return "not measured";
}

std::string writeAuditPage(const std::string &folder, const std::string &map, const MapAudit &audit) {
  makeFolder(folder);
  std::string pictures;
  const cv::Mat sheet = sheetOf(audit);
  if (!sheet.empty()) {
    std::vector<uint8_t> png;
    cv::imencode(".png", sheet, png);
    writeText(folder + "/inversion.png", std::string(png.begin(), png.end()));
    pictures =
        "<section><h2>What inversion shows</h2><p class=soft>Views from the centre. The network has never seen the "
        "place. A picture tells its place when it is more like its own truth than like that of any other view.</p>"
        "<figure class=wide><img tabindex=0 alt=\"inverted pictures beside the truth\" "
        "src=\"data:image/png;base64," +
        base64(png) + "\"></figure>" + retrievalTable(audit) + "</section>";
  }
  const std::string html =
      "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
      "content=\"width=device-width\"><title>Audit of " +
      escapeHtml(map) + "</title><style>" + kPageStyle + "</style><header><div><h1>Privacy audit</h1><p>" +
      escapeHtml(map) + "</p></div></header><main><section><h2>" +
      (audit.holds() ? "Every limit holds" : "A limit is broken: do not release this map") + "</h2>" +
      figuresTable(audit) + "</section>" + pictures + "</main></html>\n";
  const std::string page = folder + "/audit.html";
  writeText(page, html);
  return page;
}

}  // namespace sphc::host
