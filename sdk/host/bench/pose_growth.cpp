#include "host/bench/pose_growth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/bench/normal.h"
#include "host/bench/pose_table.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr size_t kCounts[] = {100, 200, 400, 800, 1500, 2500, 4000};
constexpr double kEtas[] = {0.15, 0.10};
constexpr double kFreshNoise = 0.5, kFakeVariance = 0.1;
constexpr uint64_t kGrowthSeed = 20240901;

std::vector<size_t> shuffled(size_t count, Random *random) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random->below(static_cast<uint32_t>(i))]);
  return order;
}

size_t pick(size_t count, Random *random) { return random->below(static_cast<uint32_t>(count)); }

// Which rows of the original make up `count` rows; those from `count of original` on are copies.
std::vector<size_t> chooseRows(size_t available, size_t count, Random *random) {
  std::vector<size_t> rows = shuffled(available, random);
  if (count < available) rows.resize(count);
  while (rows.size() < count) rows.push_back(pick(available, random));
  return rows;
}

// As the paper makes fakes: around the direction of some true row.
Vector3 fakeAmong(const std::vector<Correspondence> &rows, const std::vector<bool> &is_true, Random *random) {
  size_t base = pick(rows.size(), random);
  for (int i = 0; i < 1000 && !is_true[base]; ++i) base = pick(rows.size(), random);
  return (rows[base].direction + std::sqrt(kFakeVariance) * normalVector(random)).normalized();
}

void addFreshNoise(const PinholeCamera &camera, const CaseNoise &noise, Random *random, LiftedPoint *lifted) {
  const double z = lifted->point_m.z();
  const double across = kFreshNoise * noise.pixel_sigma_px / camera.fx_px;
  const double dz = kFreshNoise * (noise.depth_sigma_m + noise.depth_sigma_per_m2 * z * z) * normalOf(random);
  const Vector3 ray = lifted->point_m / z + Vector3(across * normalOf(random), across * normalOf(random), 0);
  lifted->point_m = std::max(z + dz, kNearestDepthM) * ray;
}

void resizeTruePoints(const PoseCase &original, size_t count, const CaseNoise &noise, Random *random, PoseCase *c) {
  const size_t available = original.true_points_map_m.size();
  c->true_pixels_px.clear();
  c->true_points_map_m.clear();
  if (available == 0) return;
  for (const size_t row : chooseRows(available, count, random)) {
    const bool copy = c->true_points_map_m.size() >= available;
    const double sigma = copy ? kFreshNoise * noise.pixel_sigma_px : 0;
    c->true_pixels_px.push_back(original.true_pixels_px[row] + sigma * Vector2(normalOf(random), normalOf(random)));
    c->true_points_map_m.push_back(original.true_points_map_m[row]);
  }
}

void turn(std::vector<Correspondence> *rows, std::vector<bool> *is_true, double eta, Random *random) {
  const auto wanted = static_cast<size_t>(std::lround(eta * static_cast<double>(rows->size())));
  auto left = static_cast<size_t>(std::count(is_true->begin(), is_true->end(), true));
  for (const size_t i : shuffled(rows->size(), random)) {
    if (left <= wanted) return;
    if (!(*is_true)[i]) continue;
    (*rows)[i].direction = fakeAmong(*rows, *is_true, random);
    (*is_true)[i] = false;
    --left;
  }
}

void dilute(std::vector<Correspondence> *rows, std::vector<bool> *is_true, double eta, Random *random) {
  const size_t available = rows->size();
  const auto trues = std::count(is_true->begin(), is_true->end(), true);
  const auto wanted = static_cast<size_t>(std::lround(static_cast<double>(trues) / eta));
  while (available > 0 && rows->size() < wanted) {
    Correspondence row = (*rows)[pick(available, random)];
    row.direction = fakeAmong(*rows, *is_true, random);
    rows->push_back(row);
    is_true->push_back(false);
  }
}

template <typename Make>
GrowthRow measure(const GrowthInput &input, GrowthAxis axis, const std::string &how, double x,
                  const std::vector<PoseVariant> &variants, const BenchOptions &options, Make make) {
  Random random(kGrowthSeed);
  std::vector<PoseCase> cases;
  for (const PoseCase &c : input.cases) cases.push_back(make(c, &random));
  return {input.file, axis,        how,
          x,          input.depth, summarizePoseBench(runPoseBench(cases, variants, options, nullptr))};
}

const char *axisName(GrowthAxis axis) { return axis == GrowthAxis::kCount ? "correspondences" : "eta_percent"; }

}  // namespace

PoseCase resizedCase(const PoseCase &original, size_t count, const CaseNoise &noise, Random *random) {
  PoseCase c = original;
  c.without_depth.clear();
  c.without_depth_is_true.clear();
  const size_t available = original.correspondences.size();
  if (available == 0) return c;
  c.correspondences.clear();
  c.is_true.clear();
  for (const size_t row : chooseRows(available, count, random)) {
    Correspondence correspondence = original.correspondences[row];
    if (c.correspondences.size() >= available) {
      addFreshNoise(c.camera, noise, random, &correspondence.lifted);
      if (!original.is_true[row])
        correspondence.direction = fakeAmong(original.correspondences, original.is_true, random);
    }
    c.correspondences.push_back(correspondence);
    c.is_true.push_back(original.is_true[row]);
  }
  resizeTruePoints(original, count, noise, random, &c);
  return c;
}

PoseCase turnedCase(const PoseCase &original, double eta, Random *random) {
  PoseCase c = original;
  turn(&c.correspondences, &c.is_true, eta, random);
  turn(&c.without_depth, &c.without_depth_is_true, eta, random);
  c.eta_percent = static_cast<uint32_t>(std::lround(100 * eta));
  return c;
}

PoseCase dilutedCase(const PoseCase &original, double eta, Random *random) {
  PoseCase c = original;
  dilute(&c.correspondences, &c.is_true, eta, random);
  dilute(&c.without_depth, &c.without_depth_is_true, eta, random);
  c.eta_percent = static_cast<uint32_t>(std::lround(100 * eta));
  return c;
}

std::vector<GrowthRow> growCounts(const GrowthInput &input, const std::vector<PoseVariant> &variants,
                                  const BenchOptions &options, const QueryDone &done) {
  std::vector<GrowthRow> rows;
  for (const size_t count : kCounts) {
    rows.push_back(
        measure(input, GrowthAxis::kCount, "chosen or copied", static_cast<double>(count), variants, options,
                [&](const PoseCase &c, Random *random) { return resizedCase(c, count, input.noise, random); }));
    if (done) done(static_cast<uint32_t>(rows.size()), static_cast<uint32_t>(std::size(kCounts)));
  }
  return rows;
}

std::vector<GrowthRow> growEtas(const GrowthInput &input, const std::vector<PoseVariant> &variants,
                                const BenchOptions &options, const QueryDone &done) {
  if (input.cases.empty()) return {};
  const uint32_t eta_percent = input.cases[0].eta_percent;
  std::vector<GrowthRow> rows = {measure(input, GrowthAxis::kEta, "as they are", eta_percent, variants, options,
                                         [](const PoseCase &c, Random *) { return c; })};
  if (eta_percent > 33) return rows;
  for (const double eta : kEtas) {
    if (100 * eta >= eta_percent) continue;
    for (const auto &[how, make] : {std::make_pair("turned", turnedCase), std::make_pair("added", dilutedCase)}) {
      rows.push_back(
          measure(input, GrowthAxis::kEta, how, 100 * eta, variants, options,
                  [eta, make = make](const PoseCase &c, Random *random) { return make(c, eta, random); }));
      if (done) done(static_cast<uint32_t>(rows.size()), 1 + 2 * static_cast<uint32_t>(std::size(kEtas)));
    }
  }
  return rows;
}

std::string growthText(const std::vector<GrowthRow> &rows) {
  std::vector<std::vector<std::string>> lines = {
      {"file, depth", "axis", "", "how", "variant", "ms", "p90", "p99", "x poselib", "5 cm 5 deg", "iterations"}};
  for (const GrowthRow &row : rows) {
    for (const VariantSummary &s : row.summaries) {
      const std::string ratio =
          std::isnan(s.times_faster_than_poselib) ? "-" : fixed(s.times_faster_than_poselib, 2);
      lines.push_back({row.file + ", " + depthName(row.depth), axisName(row.axis), fixed(row.x, 0), row.how, s.name,
                       fixed(s.time_ms.median, 3), fixed(s.time_ms.p90, 3), fixed(s.time_ms.p99, 3), ratio,
                       fixed(s.within_5cm_5deg_percent, 1) + " %", fixed(s.iterations, 0)});
    }
  }
  return alignedText(lines);
}

std::string growthCsv(const std::vector<GrowthRow> &rows) {
  std::string text =
      "file,depth,axis,x,how,variant,time_ms_median,time_ms_p90,time_ms_p99,times_faster_than_poselib,"
      "within_5cm_5deg_percent,rotation_deg_median,translation_cm_median,iterations_median\n";
  for (const GrowthRow &row : rows) {
    for (const VariantSummary &s : row.summaries) {
      const std::string ratio =
          std::isnan(s.times_faster_than_poselib) ? "" : fixed(s.times_faster_than_poselib, 3);
      text += row.file + "," + depthName(row.depth) + "," + axisName(row.axis) + "," + fixed(row.x, 0) + "," +
              row.how + "," + s.name + "," + fixed(s.time_ms.median, 4) + "," + fixed(s.time_ms.p90, 4) + "," +
              fixed(s.time_ms.p99, 4) + "," + ratio + "," + fixed(s.within_5cm_5deg_percent, 2) + "," +
              fixed(s.rotation_deg.median, 4) + "," + fixed(s.translation_cm.median, 4) + "," +
              fixed(s.iterations, 0) + "\n";
    }
  }
  return text;
}

nlohmann::ordered_json growthJson(const std::vector<GrowthRow> &rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const GrowthRow &row : rows) {
    nlohmann::ordered_json variants = nlohmann::ordered_json::array();
    for (const VariantSummary &s : row.summaries) variants.push_back(summaryJson(s));
    list.push_back({{"file", row.file},
                    {"depth", depthName(row.depth)},
                    {"axis", axisName(row.axis)},
                    {"x", row.x},
                    {"how", row.how},
                    {"variants", variants}});
  }
  return list;
}

}  // namespace sphc::host
