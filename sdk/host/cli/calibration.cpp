// spherecloud calibration: what calibration files hold, and the same in another format.
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/calibration/compare.h"
#include "host/calibration/convert.h"
#include "host/calibration/nearest_camera.h"
#include "host/cameras/camera_models.h"
#include "host/cameras/number_text.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/field_warnings.h"
#include "host/recording/calibration_json.h"
#include "host/report/file.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

constexpr double kExactPx = 1e-6;
constexpr double kUsualDepthUnitM = 0.001;  // of a file that has none

struct CalibrationOptions {
  std::vector<std::string> files;
  std::string format, to, out, color_size, depth_size;
  std::vector<double> color_from_depth;
  double depth_unit_m = 0;
  JoinOptions join;
  bool force = false;
};

std::vector<std::string> formatWords() {
  std::vector<std::string> words;
  for (const FormatName &name : formatNames()) words.push_back(name.name);
  return words;
}

std::optional<Format> formatOf(const std::string &word) {
  for (const FormatName &name : formatNames()) {
    if (word == name.name) return name.format;
  }
  return {};
}

ImageSize sizeOf(const std::string &option, const std::string &text) {
  ImageSize size;
  char end = 0;
  const bool is_read = std::sscanf(text.c_str(), "%5ux%5u%c", &size.width, &size.height, &end) == 2;
  const bool has_sign = text.find_first_of("+-") != std::string::npos;  // which sscanf takes
  if (!is_read || has_sign || size.width == 0 || size.height == 0)
    throw UsageError(option + " " + text + ": must be WIDTHxHEIGHT, as in 640x480");
  return size;
}

JoinOptions joinOptions(const CalibrationOptions &options) {
  JoinOptions join = options.join;
  if (!options.color_size.empty()) join.color_size = sizeOf("--color-size", options.color_size);
  if (!options.depth_size.empty()) join.depth_size = sizeOf("--depth-size", options.depth_size);
  if (options.depth_unit_m != 0) join.depth_unit_m = options.depth_unit_m;
  if (options.color_from_depth.empty()) return join;
  const double *v = options.color_from_depth.data();
  join.color_from_depth = sphc_rigid{{v[0], v[1], v[2], v[3]}, {v[4], v[5], v[6]}};
  return join;
}

// Angle between the middles of two opposite edges, degrees; NaN when the camera does not see them.
double fieldOfViewDeg(const sphc_camera &camera, bool horizontal) {
  const double w = camera.width, h = camera.height;
  const double edges[2][2] = {{horizontal ? 0 : w / 2, horizontal ? h / 2 : 0},
                              {horizontal ? w : w / 2, horizontal ? h / 2 : h}};
  double a[3], b[3];
  if (sphc_camera_unproject(&camera, edges[0], a) != SPHC_OK ||
      sphc_camera_unproject(&camera, edges[1], b) != SPHC_OK)
    return std::numeric_limits<double>::quiet_NaN();
  return std::acos(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / M_PI;
}

std::string modelOf(const sphc_camera &camera) {
  return findModel(camera.model)->name;
}  // checked when it was read

double baselineM(const sphc_rigid &rigid) { return std::hypot(rigid.t_m[0], rigid.t_m[1], rigid.t_m[2]); }

double angleDeg(const sphc_rigid &rigid) {
  const double *q = rigid.q_wxyz;
  return 2 * std::atan2(std::hypot(q[1], q[2], q[3]), std::fabs(q[0])) * 180 / M_PI;
}

std::string degrees(double angle_deg) { return std::isfinite(angle_deg) ? fixed(angle_deg, 1) : "?"; }

Row cameraRow(const std::string &name, const sphc_camera &camera) {
  return {name, modelOf(camera),
          std::to_string(camera.width) + " x " + std::to_string(camera.height) + ", focal lengths " +
              fixed(camera.params[0], 2) + ", " + fixed(camera.params[1], 2) + " px, centre " +
              fixed(camera.params[2], 2) + ", " + fixed(camera.params[3], 2) + ", sees " +
              degrees(fieldOfViewDeg(camera, true)) + " x " + degrees(fieldOfViewDeg(camera, false)) + " deg"};
}

void show(const ReadCalibration &read, const Console &console) {
  for (const ReadFile &file : read.files) console.say(file.path + " (" + nameOf(file.format).name + ")");
  const sphc_rig &c = read.calibration;
  console.say(tableText({cameraRow("colour", c.color_camera),
                         cameraRow("depth", c.depth_camera),
                         {"baseline", fixed(1000 * baselineM(c.color_from_depth), 2) + " mm",
                          "turned by " + fixed(angleDeg(c.color_from_depth), 2) + " deg"},
                         {"depth unit", fixed(1000 * c.depth_unit_m, 3) + " mm", ""}}));
  warnOfField(c, console);
}

nlohmann::ordered_json cameraJson(const sphc_camera &camera) {
  return {{"model", modelOf(camera)},
          {"width", camera.width},
          {"height", camera.height},
          {"params", std::vector<double>(camera.params, camera.params + camera.param_count)},
          {"field_of_view_deg", {fieldOfViewDeg(camera, true), fieldOfViewDeg(camera, false)}},
          {"without_ray_percent", 100 * shareWithoutRay(camera)}};
}

nlohmann::ordered_json readJson(const ReadCalibration &read) {
  const sphc_rig &c = read.calibration;
  const sphc_rigid &rigid = c.color_from_depth;
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const ReadFile &file : read.files)
    files.push_back({{"path", file.path}, {"format", nameOf(file.format).name}});
  return {{"files", files},
          {"color_camera", cameraJson(c.color_camera)},
          {"depth_camera", cameraJson(c.depth_camera)},
          {"color_from_depth",
           {{"q_wxyz", std::vector<double>(rigid.q_wxyz, rigid.q_wxyz + 4)},
            {"t_m", std::vector<double>(rigid.t_m, rigid.t_m + 3)}}},
          {"baseline_m", baselineM(rigid)},
          {"depth_unit_m", c.depth_unit_m}};
}

std::vector<std::string> writeFiles(const CalibrationOptions &options, Format format, const sphc_rig &calibration) {
  const std::vector<TextFile> files = writeCalibration(format, calibration);
  const std::string &out = options.out;
  std::vector<std::string> paths;
  for (const TextFile &file : files) paths.push_back(file.name.empty() ? out : out + "/" + file.name);
  if (nameOf(format).is_folder) makeFolder(out);
  FileUse use(options.force);  // nobody can tell one that was written here from one that somebody measured
  for (const std::string &path : options.files) use.reads("the calibration", path);
  for (const std::string &path : paths) use.writes("--out", path, never());
  use.check();
  for (size_t i = 0; i < files.size(); ++i) writeFile(paths[i], files[i].text);
  if (format == Format::kColmap) paths.pop_back();  // rigs.txt is found beside cameras.txt
  return paths;
}

// What was written, read again: how far from what it was made of.
CalibrationDifference roundTrip(const std::vector<std::string> &paths, Format format, const sphc_rig &calibration) {
  JoinOptions options;
  options.depth_unit_m = calibration.depth_unit_m;
  const std::optional<Format> forced = paths.size() == 1 ? std::optional<Format>(format) : std::nullopt;
  return compareCalibrations(calibration, readCalibrationFiles(paths, forced, options).calibration);
}

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e px", value);
  return text;
}

Row differenceRow(const std::string &name, const PixelDifference &d) {
  std::string note =
      d.samples > 0 ? "rms " + scientific(d.rms_px) + " of " + std::to_string(d.samples) : "nothing was compared";
  if (d.lost > 0) note += "; " + std::to_string(d.lost) + " more points have lost their pixel";
  return {name, d.samples > 0 ? scientific(d.largest_px) : "-", note};
}

// Null where nothing was compared.
nlohmann::ordered_json differenceJson(const std::string &name, const PixelDifference &d) {
  const auto compared = [&](double px) {
    return d.samples > 0 ? nlohmann::ordered_json(px) : nlohmann::ordered_json();
  };
  return {{"what", name},
          {"largest_px", compared(d.largest_px)},
          {"rms_px", compared(d.rms_px)},
          {"samples", d.samples},
          {"lost", d.lost}};
}

std::vector<std::pair<std::string, PixelDifference>> parts(const CalibrationDifference &difference) {
  std::vector<std::pair<std::string, PixelDifference>> result = {{"colour", difference.color},
                                                                 {"depth", difference.depth}};
  for (size_t i = 0; i < kComparedDepthsM.size(); ++i)
    result.emplace_back("depth to colour at " + fixed(kComparedDepthsM[i], 1) + " m", difference.depth_to_color[i]);
  return result;
}

nlohmann::ordered_json convert(const CalibrationOptions &options, Format format, const sphc_rig &calibration,
                               const Console &console) {
  const sphc_rig fitted = fitToFormat(calibration, format, options.join.approximate);
  const std::vector<std::string> paths = writeFiles(options, format, fitted);
  const CalibrationDifference difference = roundTrip(paths, format, calibration);
  const bool exact = formatHolds(format, calibration.color_camera) && formatHolds(format, calibration.depth_camera);
  std::vector<Row> rows;
  nlohmann::ordered_json json = {{"path", options.out},
                                 {"format", nameOf(format).name},
                                 {"exact", exact},
                                 {"round_trip", nlohmann::ordered_json::array()}};
  for (const auto &[name, part] : parts(difference)) {
    rows.push_back(differenceRow(name, part));
    json["round_trip"].push_back(differenceJson(name, part));
  }
  console.say("Wrote " + options.out + " (" + nameOf(format).name + (exact ? "" : ", the nearest it holds") +
              ") and read it again; largest difference in pixels:");
  console.say(tableText(rows));
  if (!nameOf(format).has_depth_unit && calibration.depth_unit_m != kUsualDepthUnitM)
    console.warn("note: " + std::string(nameOf(format).name) + " has no depth unit; give --depth-unit " +
                 numberText(calibration.depth_unit_m) + " where " + options.out + " is read");
  if (exact && (difference.largestPx() > kExactPx || difference.lost() > 0))
    throw std::runtime_error(options.out + ": reads back differently, by " + scientific(difference.largestPx()) +
                             "; do not use it");
  return json;
}

int calibration(const CalibrationOptions &options, const Console &console) {
  if (options.out.empty() && !options.to.empty())
    throw UsageError("--to names a format, but --out names no file; give both");
  const ReadCalibration read = readCalibrationFiles(options.files, formatOf(options.format), joinOptions(options));
  show(read, console);
  nlohmann::ordered_json json = readJson(read);
  if (!options.out.empty())
    json["written"] =
        convert(options, formatOf(options.to).value_or(Format::kSpherecloud), read.calibration, console);
  console.give(json);
  return kExitDone;
}

const char kCalibrationHelp[] =
    "Reads calibration files of OpenCV, Kalibr, ROS, COLMAP, Azure Kinect or this SDK, shows what they say, and\n"
    "writes it in another of these formats.  What was written is read again and compared: the round-trip error.\n"
    "Files with one camera: first that of colour, then that of depth, then one with R and T.";
const char kCalibrationExample[] =
    "Example:\n"
    "  spherecloud calibration camchain.yaml\n"
    "  spherecloud calibration camchain.yaml --out calibration.json\n"
    "  spherecloud calibration color.yaml depth.yaml extrinsics.yml --to colmap --out sparse\n"
    "  spherecloud calibration kinect.json --color-size 1280x720 --depth-size 640x576 --to opencv --out "
    "kinect.yml\n"
    "docs/calibration.md has what each format can hold, and what is assumed of it.";

void addOptions(CLI::App *app, CalibrationOptions *options) {
  app->add_option("files", options->files, "Calibration files; a folder is one that --to ros or --to colmap wrote")
      ->required()
      ->type_name("FILE");
  app->add_option("--format", options->format, "Format of all files [each tells by itself]")
      ->check(CLI::IsMember(formatWords()));
  app->add_option("-o,--out", options->out, "Write it here; a folder for ros and colmap")->type_name("FILE");
  app->add_option("--to", options->to, "Format to write [spherecloud]")->check(CLI::IsMember(formatWords()));
  app->add_flag("--approximate", options->join.approximate,
                "Take the nearest camera where a model cannot be held exactly");
  addForceOption(app, &options->force);
  const char *group = "What files may leave open";
  app->add_option("--color", options->join.color, "Name of the colour camera in the files [color, or the first]")
      ->type_name("NAME")
      ->group(group);
  CLI::Option *depth = app->add_option("--depth", options->join.depth,
                                       "Name of the depth camera in the files [depth, or the second]")
                           ->type_name("NAME")
                           ->group(group);
  app->add_option("--color-size", options->color_size,
                  "Size of colour images; with azure-kinect it chooses the mode")
      ->type_name("WxH")
      ->group(group);
  CLI::Option *depth_size = app->add_option("--depth-size", options->depth_size, "Size of depth images, likewise")
                                ->type_name("WxH")
                                ->group(group);
  CLI::Option *color_from_depth =
      app->add_option("--color-from-depth", options->color_from_depth, "QW,QX,QY,QZ,TX,TY,TZ; metres")
          ->delimiter(',')
          ->expected(7)
          ->type_name("POSE")
          ->group(group);
  app->add_flag("--registered", options->join.registered, "Depth lies on colour already: one camera is enough")
      ->excludes(depth)
      ->excludes(depth_size)
      ->excludes(color_from_depth)
      ->group(group);
  app->add_option("--depth-unit", options->depth_unit_m,
                  "Metres per unit of the depth image [the file's, or 0.001]")
      ->check(between(1e-9, 1))
      ->type_name("M")
      ->group(group);
}

}  // namespace

Command calibrationCommand(CLI::App *root) {
  auto options = std::make_shared<CalibrationOptions>();
  CLI::App *app = root->add_subcommand("calibration");
  app->description("Show and convert calibration files.\n\n" + std::string(kCalibrationHelp));
  app->footer(kCalibrationExample);
  addOptions(app, options.get());
  return {app, [options](const Console &console) { return calibration(*options, console); }};
}

}  // namespace sphc::host
