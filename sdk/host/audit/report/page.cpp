#include "host/audit/report/page.h"

#include <filesystem>

#include "host/audit/score/inversion_sheet.h"
#include "host/base/listed.h"
#include "host/base/write_file.h"
#include "host/report/encode.h"
#include "host/report/file.h"
#include "host/report/page_style.h"
#include "host/report/picture_bytes.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

std::string cell(const std::string &text) { return "<td>" + escapeHtml(text) + "</td>"; }

std::string figuresTable(const MapAudit &audit) {
  std::string html =
      "<table><thead><tr><th>Figure</th><th>Value</th><th>Limit</th><th>Verdict</th><th></th></tr></thead>";
  for (const AuditFigure &figure : audit.figures) {
    const FigureKind &kind = figure.kind;
    html += "<tr>" + cell(kind.about) + "<td class=value>" + (figure.value ? fixed(*figure.value, 3) : "-") +
            (figure.standard_error > 0 ? " &plusmn; " + fixed(figure.standard_error, 3) : "") + "</td>" +
            cell(kind.limit ? (kind.at_most ? "at most " : "at least ") + fixed(*kind.limit, 3) : "") +
            cell(wordFor(figure)) + "<td class=soft>" + escapeHtml(figure.remark) + " <code>" +
            escapeHtml(kind.name) + "</code></td></tr>";
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

std::string wordFor(const AuditFigure &figure) {
  switch (figure.verdict()) {
    case Verdict::kHolds:
      return "holds";
    case Verdict::kBroken:
      return "BROKEN";
    case Verdict::kInformation:
      return "for information";
    case Verdict::kDoesNotApply:
      return "does not apply";
    case Verdict::kNotMeasured:
      break;
  }
  if (!figure.kind.limit) return "not measured";
  return figure.may_stay_unmeasured ? "not measured, as allowed" : "NOT MEASURED";
}

std::string outcomeText(const MapAudit &audit) {
  const std::string allowed =
      audit.allowedGates().empty() ? "" : " Not measured, as allowed: " + listed(audit.allowedGates()) + ".";
  switch (audit.outcome()) {
    case AuditOutcome::kHolds:
      return (allowed.empty() ? "Every limit holds." : "Every limit that was measured holds.") + allowed;
    case AuditOutcome::kBroken:
      return "A limit is broken: do not release this map." + allowed;
    case AuditOutcome::kNotMeasured:
      break;
  }
  return "No limit is broken, but some were not measured: " + listed(audit.missingGates()) +
         ". Give what they need, or allow it with --allow-unmeasured." + allowed;
}

std::string writeAuditPage(const std::string &folder, const std::string &map, const MapAudit &audit) {
  makeFolder(folder);
  std::string pictures;
  std::vector<uint8_t> png;
  const cv::Mat sheet = inversionSheet(audit.views, audit.inversions);
  if (!sheet.empty()) {
    png = pngOf(sheet);
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
      escapeHtml(map) + "</p></div></header><main><section><h2>" + escapeHtml(outcomeText(audit)) + "</h2>" +
      (audit.quick ? "<p class=soft>A quick audit: fewer lines and views.</p>" : "") + figuresTable(audit) +
      "</section>" + pictures + "</main></html>\n";
  const std::string page = folder + "/audit.html";
  writeFile(page, html, Readers::kOwner);  // first: by it the next audit knows the folder
  const std::string picture = folder + "/inversion.png";
  std::error_code ignored;
  if (png.empty())
    std::filesystem::remove(picture, ignored);  // of an audit before
  else
    writeFile(picture, png, Readers::kOwner);
  return page;
}

}  // namespace sphc::host
