#include "lab/align/bench.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/frames/image_edges.h"
#include "host/report/statistics.h"
#include "host/report/table.h"
#include "lab/align/depth_edges.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

constexpr uint32_t kKeypoints = 800, kGapPx = 10;

// What one variant gathers over the frames.
struct Gathered {
  AlignFunction align;
  AlignRow row;
  std::vector<double> milliseconds, distances;
  double with_depth = 0, occluded = 0;
  AlignedFrame last;
};

double percentOf(double part, double whole) { return 100 * part / whole; }

void gather(const AlignCase &c, const std::vector<uint8_t> &edges, std::vector<double> seconds, Gathered *g) {
  g->milliseconds.push_back(1e3 * percentile(std::move(seconds), 0.5));
  const auto &depth = g->last.depth;
  g->with_depth +=
      static_cast<double>(depth.size()) - static_cast<double>(std::count(depth.begin(), depth.end(), 0));
  const auto &mask = g->last.mask;
  g->occluded += static_cast<double>(std::count(mask.begin(), mask.end(), uint8_t{SPHC_ALIGNED_OCCLUDED}));
  edgeDistances(depthEdges(depth, c.color().width, c.color().height, kGapPx), edges, c.color().width,
                c.color().height, &g->distances);
}

AlignRow summarize(const AlignCase &c, const Gathered &g, double ours_ms) {
  AlignRow row = g.row;
  const double pixels =
      static_cast<double>(c.color().width) * c.color().height * static_cast<double>(c.frames.size());
  row.median_ms = percentile(g.milliseconds, 0.5);
  row.p99_ms = percentile(g.milliseconds, 0.99);
  row.times_slower = row.median_ms / ours_ms;
  row.with_depth_percent = percentOf(g.with_depth, pixels);
  row.occluded_percent =
      g.last.mask.empty() ? std::numeric_limits<double>::quiet_NaN() : percentOf(g.occluded, pixels);
  row.edge_median_px = percentile(g.distances, 0.5);
  return row;
}

std::string number(double value, int digits) { return std::isfinite(value) ? fixed(value, digits) : "-"; }

}  // namespace

std::vector<uint16_t> laidOver(const AlignCase &c, const AlignFrame &frame) {
  const double scale = static_cast<double>(c.depth().width) / c.color().width;
  const double above = 0.5 * (c.depth().height - scale * c.color().height);
  std::vector<uint16_t> depth(size_t{c.color().width} * c.color().height);
  for (uint32_t y = 0; y < c.color().height; ++y) {
    const double v = (y + 0.5) * scale + above;
    if (v < 0 || v >= c.depth().height) continue;
    for (uint32_t x = 0; x < c.color().width; ++x)
      depth[size_t{y} * c.color().width + x] =
          frame.depth[static_cast<size_t>(v) * c.depth().width + static_cast<size_t>((x + 0.5) * scale)];
  }
  return depth;
}

AlignTable runAlignBench(const AlignCase &c, const std::vector<AlignVariant> &variants, uint32_t repeats,
                         const FrameDone &done) {
  std::vector<Gathered> all;
  for (const AlignVariant &variant : variants) {
    if (!variant.make) continue;
    all.emplace_back();
    all.back().align = variant.make(c);
    all.back().row.name = variant.name;
  }
  AlignTable table;
  table.name = c.name;
  table.frames = c.frames.size();
  const auto lift = sparseLift(c, kKeypoints);
  std::vector<double> before, sparse_ms;
  for (size_t f = 0; f < c.frames.size(); ++f) {
    const AlignFrame &frame = c.frames[f];
    std::vector<std::vector<double>> seconds(all.size() + 1);
    for (uint32_t repeat = 0; repeat < repeats; ++repeat) {
      for (size_t v = 0; v < all.size(); ++v) {
        all[v].align(frame, &all[v].last);
        seconds[v].push_back(all[v].last.seconds);
      }
      const SparseTime time = lift(frame);
      seconds.back().push_back(time.seconds);
      if (repeat == 0) table.lifted_mean += time.lifted / static_cast<double>(c.frames.size());
    }
    const std::vector<uint8_t> edges = imageEdges(frame.gray, c.color().width, c.color().height);
    for (size_t v = 0; v < all.size(); ++v) gather(c, edges, seconds[v], &all[v]);
    sparse_ms.push_back(1e3 * percentile(seconds.back(), 0.5));
    edgeDistances(depthEdges(laidOver(c, frame), c.color().width, c.color().height, kGapPx), edges, c.color().width,
                  c.color().height, &before);
    if (done) done(static_cast<uint32_t>(f + 1), static_cast<uint32_t>(c.frames.size()));
  }
  table.edge_before_px = percentile(before, 0.5);
  table.sparse_median_ms = percentile(sparse_ms, 0.5);
  table.sparse_p99_ms = percentile(sparse_ms, 0.99);
  double ours_ms = std::numeric_limits<double>::quiet_NaN();
  for (const Gathered &g : all)
    if (g.row.name == kAlignOurs) ours_ms = percentile(g.milliseconds, 0.5);
  for (const Gathered &g : all) table.rows.push_back(summarize(c, g, ours_ms));
  return table;
}

std::string alignText(const AlignTable &table) {
  std::vector<std::vector<std::string>> rows = {
      {"aligner", "ms", "p99", "x ours", "with depth", "occluded", "edge px"}};
  for (const AlignRow &r : table.rows)
    rows.push_back({r.name, number(r.median_ms, 2), number(r.p99_ms, 2), number(r.times_slower, 2),
                    number(r.with_depth_percent, 1) + " %", number(r.occluded_percent, 2) + " %",
                    number(r.edge_median_px, 2)});
  return "depth " + table.name + ", " + std::to_string(table.frames) + " frames; edges " +
         number(table.edge_before_px, 2) + " px from the image's before\n" + alignedText(rows) +
         "800 keypoints, of them " + number(table.lifted_mean, 0) +
         " lifted: " + number(table.sparse_median_ms, 3) + " ms, p99 " + number(table.sparse_p99_ms, 3) + "\n";
}

std::string alignResults(const std::vector<AlignTable> &tables) {
  std::string text =
      "depth,aligner,times_slower_than_ours,with_depth_percent,occluded_percent,edge_before_px,edge_px\n";
  for (const AlignTable &table : tables)
    for (const AlignRow &r : table.rows)
      text += table.name + "," + csvText(r.name) + "," + number(r.times_slower, 1) + "," +
              number(r.with_depth_percent, 1) + "," + number(r.occluded_percent, 2) + "," +
              number(table.edge_before_px, 2) + "," + number(r.edge_median_px, 2) + "\n";
  return text;
}

nlohmann::ordered_json alignJson(const std::vector<AlignTable> &tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const AlignTable &table : tables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const AlignRow &r : table.rows)
      rows.push_back({{"name", r.name},
                      {"time_ms", {{"median", r.median_ms}, {"p99", r.p99_ms}}},
                      {"times_slower_than_ours", r.times_slower},
                      {"with_depth_percent", r.with_depth_percent},
                      {"occluded_percent", r.occluded_percent},
                      {"edge_px", r.edge_median_px}});
    list.push_back({{"depth", table.name},
                    {"frames", table.frames},
                    {"edge_before_px", table.edge_before_px},
                    {"sparse_ms", {{"median", table.sparse_median_ms}, {"p99", table.sparse_p99_ms}}},
                    {"aligners", rows}});
  }
  return list;
}

}  // namespace sphc::host
