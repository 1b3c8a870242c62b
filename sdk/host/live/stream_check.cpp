#include "host/live/stream_check.h"

#include <algorithm>
#include <cmath>

#include "host/base/counted.h"
#include "host/base/median.h"
#include "host/recording/pixels.h"
#include "host/report/run.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

using Grade = Finding::Grade;
constexpr uint32_t kEvery = 7;                       // pixels looked at
constexpr double kMostApartMs = 20;                  // of which walking makes 7 mm: as much as a good pose is off
constexpr double kMostUnpaired = 0.1;                // of the rarer stream's images
constexpr double kPauseMs = 500, kPausePeriods = 5;  // longer than both is a pause
constexpr uint64_t kFnvStart = 0xCBF29CE484222325u, kFnvPrime = 0x100000001B3u;  // Fowler, Noll and Vo's hash

uint32_t pixelAt(const sphc_image &image, uint32_t x, uint32_t y) {
  const auto *row = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
  if (image.format == SPHC_FORMAT_DEPTH16) return reinterpret_cast<const uint16_t *>(row)[x];
  return image.format == SPHC_FORMAT_GRAY8 ? row[x] : row[3 * x + 1];
}

const char *pointName(sphc_time_point point) {
  const char *const names[] = {"the middle", "the start", "the end", "not the exposure but the arrival"};
  return point >= 0 && point < 4 ? names[point] : "an unknown point";
}

// What times may be in that should be in seconds.
struct TimeUnit {
  const char *name, *a_second;
  double seconds;
};
constexpr TimeUnit kTimeUnits[] = {
    {"milliseconds", "1000", 1e-3}, {"microseconds", "1000000", 1e-6}, {"nanoseconds", "1000000000", 1e-9}};
constexpr double kFastest_s = 1.0 / 95, kSlowest_s = 1;  // periods of cameras of depth
// Stills may be ten seconds apart, but neither for so long nor as regularly as a camera gives its images.
constexpr double kLongestOfStills_s = 1200, kMostUneven = 1.3;
constexpr size_t kFewestRegular = 10;

bool mayBeStills(const std::vector<double> &periods_ms) {
  double all_s = 0;
  for (const double period_ms : periods_ms) all_s += 1e-3 * period_ms;
  if (all_s > kLongestOfStills_s) return false;
  return periods_ms.size() < kFewestRegular ||
         percentile(periods_ms, 0.9) > kMostUneven * percentile(periods_ms, 0.1);
}

// In which the period is one of a camera, where it is not in seconds; null: none.
const TimeUnit *unitOfPeriod(double period_s) {
  for (const TimeUnit &unit : kTimeUnits)
    if (period_s * unit.seconds >= kFastest_s && period_s * unit.seconds <= kSlowest_s) return &unit;
  return nullptr;
}

// Of the stream with fewer images, those for which the other one had none.  All images of the other one that are
// too many have no partner either, which is nothing amiss: cameras may have two rates.
double unpairedShare(size_t pairs, const StreamCounts &counts) {
  const uint64_t due = std::max<uint64_t>(counts.color, counts.depth);
  const uint64_t found_or_not = pairs + counts.without_partner;
  const uint64_t unpaired = found_or_not - std::min(found_or_not, due);
  return static_cast<double>(unpaired) / static_cast<double>(pairs + unpaired);
}

}  // namespace

StreamCheck::StreamCheck(sphc_stream stream, const sphc_rig &calibration, bool is_recording)
    : is_color_(stream == SPHC_STREAM_COLOR),
      is_recording_(is_recording),
      camera_(is_color_ ? calibration.color_camera : calibration.depth_camera),
      depth_unit_m_(calibration.depth_unit_m) {}

void StreamCheck::look(const sphc_capture &capture) {
  if (count_++ == 0) {
    first_ = capture;
  } else {
    periods_ms_.push_back(1e-6 * static_cast<double>(capture.time_ns - last_.time_ns));
    if (capture.sequence > last_.sequence) steps_.push_back(capture.sequence - last_.sequence);
  }
  last_ = capture;
  const sphc_image &image = capture.image;
  double sum = 0;
  uint64_t hash = kFnvStart;
  uint32_t pixels = 0, measured = 0;
  for (uint32_t y = kEvery / 2; y < image.height; y += kEvery)
    for (uint32_t x = kEvery / 2; x < image.width; x += kEvery, ++pixels) {
      const uint32_t value = pixelAt(image, x, y);
      sum += value;
      hash = (hash ^ value) * kFnvPrime;
      if (is_color_ || value == 0) continue;
      ++measured;
      if (count_ % 10 == 1) depths_m_.push_back(value * depth_unit_m_);
    }
  if (pixels == 0) return;
  repeated_ += count_ > 1 && hash == last_pixels_;
  last_pixels_ = hash;
  brightness_.push_back(sum / pixels);
  measured_share_.push_back(static_cast<double>(measured) / pixels);
}

Findings StreamCheck::findings() const {
  if (count_ == 0)
    return {{Grade::kWrong, is_color_ ? "colour" : "depth",
             is_recording_ ? "not one image can be read; is the recording whole? Copy it again"
                           : "not one image came; is another program using the camera, or its shutter closed?"}};
  if (const std::optional<Finding> wrong = size()) return {*wrong};
  Findings findings = {rate(), clock(), is_color_ ? brightness() : depths()};
  if (const std::optional<Finding> same = frozen()) findings.push_back(*same);
  return findings;
}

// No sensor gives the same noise twice.
std::optional<Finding> StreamCheck::frozen() const {
  if (10 * repeated_ <= count_) return std::nullopt;
  return Finding{
      2 * repeated_ > count_ ? Grade::kWrong : Grade::kDoubtful, is_color_ ? "colour images" : "depth images",
      std::to_string(repeated_) + " of " + std::to_string(count_) +
          " are the ones before over again; the stream is stale: start the camera anew, or ask it for fewer "
          "images a second" +
          (is_recording_ ? ", and record anew" : "")};
}

std::optional<Finding> StreamCheck::size() const {
  const sphc_image &image = last_.image;
  if (image.width == camera_.width && image.height == camera_.height) return std::nullopt;
  return Finding{Grade::kWrong, is_color_ ? "colour size" : "depth size",
                 "images are " + recording::sizeText(image.width, image.height) + ", the calibration is for " +
                     recording::sizeText(camera_.width, camera_.height) +
                     "; choose that mode (--width, --height), or calibrate this one"};
}

// Between those that can be.
uint64_t StreamCheck::unreadable() const {
  const auto is_between = [this](int64_t time_ns) { return time_ns >= first_.time_ns && time_ns <= last_.time_ns; };
  const auto expected = static_cast<uint64_t>(std::count_if(expected_ns_.begin(), expected_ns_.end(), is_between));
  return expected > count_ ? expected - count_ : 0;
}

// By their numbers.  A recording may hold every third frame, say: that is its rate, and no loss.
uint64_t StreamCheck::lost() const {
  const double usual = is_recording_ ? std::max(1.0, median(steps_)) : 1;
  uint64_t lost = 0;
  for (const double step : steps_) lost += static_cast<uint64_t>(std::max(1.0, std::floor(step / usual))) - 1;
  return lost - std::min(lost, unreadable());
}

Finding StreamCheck::rate() const {
  const std::string what = is_color_ ? "colour rate" : "depth rate";
  if (periods_ms_.empty()) return {Grade::kDoubtful, what, "one image only"};
  const double median_ms = percentile(periods_ms_, 0.5), most_ms = percentile(periods_ms_, 1);
  const TimeUnit *unit = is_recording_ && !mayBeStills(periods_ms_) ? unitOfPeriod(1e-3 * median_ms) : nullptr;
  if (unit)
    return {Grade::kWrong, what,
            "an image every " + fixed(1e-3 * median_ms, 0) + " s, and no camera is so slow: are the times in " +
                unit->name + "? Seconds are expected; divide the times of images and poses by " + unit->a_second};
  const uint64_t lost = this->lost(), unreadable = this->unreadable(), all = count_ + lost + unreadable;
  const std::string seen = fixed(1000 / median_ms, 1) + " images a second, longest pause " + fixed(most_ms, 0) +
                           " ms, " + std::to_string(lost) + " of " + std::to_string(all) + " never came" +
                           (unreadable > 0 ? ", and " + std::to_string(unreadable) + " cannot be read" : "");
  if (10 * (lost + unreadable) > count_)
    return {Grade::kWrong, what,
            seen + (is_recording_ ? "; copy the recording again, or record anew"
                                  : "; at the camera, use another USB port or bus, a smaller image, or MJPG")};
  const bool paused = most_ms > std::max(kPauseMs, kPausePeriods * median_ms);
  return {lost + unreadable > 0 || paused ? Grade::kDoubtful : Grade::kFine, what, seen};
}

Finding StreamCheck::clock() const {
  const std::string what = is_color_ ? "colour clock" : "depth clock";
  std::string seen = last_.clock == SPHC_CLOCK_MONOTONIC  ? "the host's CLOCK_MONOTONIC"
                     : last_.clock == SPHC_CLOCK_BOOTTIME ? "the host's CLOCK_BOOTTIME"
                                                          : "the camera's own";
  seen += "; times are those of " + std::string(pointName(last_.time_point)) +
          (last_.time_point == SPHC_TIME_ARRIVAL ? "" : " of the exposure");
  if (last_.time_sigma_us > 0) seen += ", good to " + fixed(last_.time_sigma_us / 1000.0, 1) + " ms";
  if (last_.time_point == SPHC_TIME_MIDDLE) return {Grade::kFine, what, seen};
  if (last_.exposure_us > 0)
    return {Grade::kFine, what, seen + "; the exposure is known, so they are moved to its middle"};
  return {Grade::kDoubtful, what,
          seen +
              "; the camera does not tell its exposure, so they may be off by half of it: fix the exposure, or "
              "light the room"};
}

Finding StreamCheck::brightness() const {
  const double mean = percentile(brightness_, 0.5);
  const std::string seen = "mean " + fixed(mean, 0) + " of 255";
  if (mean < 25) return {Grade::kDoubtful, "brightness", seen + "; too dark for keypoints: more light or exposure"};
  if (mean > 230) return {Grade::kDoubtful, "brightness", seen + "; overexposed: less exposure or gain"};
  return {Grade::kFine, "brightness", seen};
}

Finding StreamCheck::depths() const {
  const double share = percentile(measured_share_, 0.5);
  const std::string measured = fixed(100 * share, 0) + " % of the pixels are measured";
  if (share < 0.1 || depths_m_.empty())
    return {Grade::kWrong, "depth", measured + "; is the ToF emitter on, its window clean, and a wall within 5 m?"};
  const double near_m = percentile(depths_m_, 0.05), middle_m = percentile(depths_m_, 0.5),
               far_m = percentile(depths_m_, 0.95);
  const std::string seen = measured + ", from " + fixed(near_m, 2) + " to " + fixed(far_m, 2) +
                           " m, half of them beyond " + fixed(middle_m, 2) + " m";
  if (middle_m < 0.1 || middle_m > 20)
    return {Grade::kWrong, "depth",
            seen + "; no room is like that: is depth_unit_m " + fixed(depth_unit_m_, 6) +
                " right? 0.001 is a millimetre"};
  return {share < 0.4 ? Grade::kDoubtful : Grade::kFine, "depth", seen};
}

Finding pairsFinding(const std::vector<double> &color_minus_depth_ms, const StreamCounts &counts) {
  if (color_minus_depth_ms.empty())
    return {
        Grade::kWrong, "pairs",
        "no colour and depth image were taken at the same time; is one stream silent, or are they on two clocks? "
        "--tolerance-ms widens what counts as the same"};
  const double median_ms = percentile(color_minus_depth_ms, 0.5);
  const double spread_ms = percentile(color_minus_depth_ms, 0.95) - percentile(color_minus_depth_ms, 0.05);
  const std::string seen = "of " + counted(color_minus_depth_ms.size(), "pair") + " colour is taken " +
                           fixed(std::fabs(median_ms), 1) + " ms " + (median_ms < 0 ? "before" : "after") +
                           " depth, within " + fixed(spread_ms, 1) + " ms; " +
                           counted(counts.without_partner, "image") + " had no partner";
  if (spread_ms > 10)
    return {Grade::kDoubtful, "pairs",
            seen + "; the cameras drift apart: synchronise them, or expect blur from motion"};
  if (std::fabs(median_ms) > kMostApartMs)
    return {Grade::kDoubtful, "pairs",
            seen +
                "; the camera moves between them, so poses are less sure: give the localizer odometry, or "
                "let one trigger start both"};
  const double unpaired = unpairedShare(color_minus_depth_ms.size(), counts);
  if (unpaired > kMostUnpaired)
    return {Grade::kDoubtful, "pairs",
            seen + ", so " + fixed(100 * unpaired, 0) +
                " % of the rarer stream's images are of no use: trigger both cameras together, or stamp their "
                "images by one clock"};
  return {Grade::kFine, "pairs", seen};
}

}  // namespace sphc::host
