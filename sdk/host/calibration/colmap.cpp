// COLMAP's cameras.txt, and rigs.txt of 3.12 and later.
#include <algorithm>
#include <cmath>
#include <map>

#include "host/calibration/colmap_camera.h"
#include "host/calibration/formats.h"
#include "host/cameras/camera_models.h"
#include "host/cameras/fault.h"
#include "host/cameras/intrinsics.h"
#include "host/cameras/number_text.h"
#include "host/cameras/rigid_matrix.h"
#include "host/recording/text_field.h"

namespace sphc::host {
namespace {

// The words of one line, and where it stands.
struct Line {
  std::string place;
  std::vector<std::string_view> words;
};

std::vector<Line> linesOf(std::string_view text) {
  std::vector<Line> lines;
  for (size_t number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    Line line = {"line " + std::to_string(number), {}};
    for (std::string_view word = recording::takeWord(rest); !word.empty(); word = recording::takeWord(rest))
      line.words.push_back(word);
    if (!line.words.empty() && line.words[0][0] != '#') lines.push_back(std::move(line));
  }
  return lines;
}

double number(const std::string &file, const Line &line, size_t index) {
  double value = 0;
  if (!recording::parseDouble(line.words[index], value) || !std::isfinite(value))
    refuse(file, line.place,
           "word " + std::to_string(index + 1) + " is " + shown(line.words[index]) + "; must be a finite number");
  return value;
}

uint32_t pixels(const std::string &file, const Line &line, size_t index) {
  uint32_t value = 0;
  if (!recording::parseUnsigned(line.words[index], value) || !isImageSide(value))
    refuse(file, line.place, "width or height is " + shown(line.words[index]) + "; " + imageSideCure());
  return value;
}

NamedCamera readCamera(const std::string &file, const Line &line) {
  if (line.words.size() < 4) refuse(file, line.place, "must be CAMERA_ID MODEL WIDTH HEIGHT PARAMS");
  const ColmapCameraModel *model = findColmapModel(line.words[1]);
  if (!model)
    refuse(file, line.place, "camera model is " + shown(line.words[1]) + "; known here: " + knownColmapModels());
  if (line.words.size() != 4 + model->slots.size())
    refuse(file, line.place,
           "has " + std::to_string(line.words.size() - 4) + " parameters; " + model->name + " takes " +
               std::to_string(model->slots.size()));
  std::vector<double> params;
  for (size_t i = 0; i < model->slots.size(); ++i) params.push_back(number(file, line, 4 + i));
  NamedCamera camera;
  camera.name = line.words[0];
  camera.camera = colmapCamera(*model, pixels(file, line, 2), pixels(file, line, 3), params);
  return camera;
}

using PoseOfCamera = std::map<std::string, sphc_rigid, std::less<>>;

sphc_rigid readPose(const std::string &file, const Line &line, size_t first) {
  double values[7];
  for (size_t i = 0; i < 7; ++i) values[i] = number(file, line, first + i);
  sphc_rigid pose = {{values[0], values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
  if (!normalizeQuaternion(pose.q_wxyz, 1e-3))
    refuse(file, line.place,
           "word " + std::to_string(first + 1) + ": the quaternion is not of unit length; order QW QX QY QZ");
  return pose;
}

// RIG_ID NUM_SENSORS REF_TYPE REF_ID, then TYPE ID HAS_POSE and the pose, sensor_from_rig, if there is one.
PoseOfCamera readRig(const std::string &file, const Line &line) {
  constexpr const char *kShape =
      "must be RIG_ID NUM_SENSORS REF_SENSOR_TYPE REF_SENSOR_ID, and for each further sensor "
      "SENSOR_TYPE SENSOR_ID HAS_POSE QW QX QY QZ TX TY TZ";
  const auto &words = line.words;
  if (words.size() < 4) refuse(file, line.place, kShape);
  PoseOfCamera poses;
  if (words[2] == "CAMERA") poses[std::string(words[3])] = {{1, 0, 0, 0}, {0, 0, 0}};
  for (size_t at = 4; at < words.size();) {
    if (at + 3 > words.size()) refuse(file, line.place, kShape);
    const bool has_pose = words[at + 2] == "1";
    if (!has_pose && words[at + 2] != "0") refuse(file, line.place, kShape);
    if (has_pose && at + 10 > words.size()) refuse(file, line.place, kShape);
    if (has_pose && words[at] == "CAMERA") {
      const sphc_rigid pose = readPose(file, line, at + 3);
      if (!poses.emplace(words[at + 1], pose).second)
        refuse(file, line.place, "camera " + shown(words[at + 1]) + " stands there twice; remove one");
    }
    at += has_pose ? 10 : 3;
  }
  return poses;
}

std::string lineOf(int id, const sphc_camera &camera) {
  const char *name = "FULL_OPENCV";
  size_t count = 12;
  if (hasFourCoefficients(camera)) name = "OPENCV", count = 8;
  if (camera.model == SPHC_CAMERA_PINHOLE) name = "PINHOLE", count = 4;
  if (isFisheye(camera)) name = "OPENCV_FISHEYE", count = 8;
  return std::to_string(id) + " " + name + " " + std::to_string(camera.width) + " " +
         std::to_string(camera.height) + " " + numbersText({camera.params, camera.params + count}, " ") + "\n";
}

}  // namespace

CalibrationPart readColmap(const TextFile &cameras, const TextFile *rigs) {
  CalibrationPart part;
  for (const Line &line : linesOf(cameras.text)) {
    NamedCamera camera = readCamera(cameras.name, line);
    for (const NamedCamera &other : part.cameras) {
      if (other.name == camera.name)
        refuse(cameras.name, line.place, "camera " + shown(camera.name) + " stands there twice; remove one");
    }
    part.cameras.push_back(std::move(camera));
  }
  if (part.cameras.empty()) refuse(cameras.name, "the file", "has no camera; is it COLMAP's cameras.txt?");
  if (!rigs) return part;
  // The rig that joins most of the cameras; one of a single camera says nothing.
  PoseOfCamera best;
  for (const Line &line : linesOf(rigs->text)) {
    PoseOfCamera poses = readRig(rigs->name, line);
    if (poses.size() > best.size()) best = std::move(poses);
  }
  for (NamedCamera &camera : part.cameras) {
    const auto pose = best.find(camera.name);
    if (pose != best.end()) camera.camera_from_rig = pose->second;
  }
  return part;
}

std::vector<TextFile> colmapTexts(const sphc_rig &calibration) {
  const sphc_rigid depth_from_color = inverse(calibration.color_from_depth);
  std::vector<double> pose(depth_from_color.q_wxyz, depth_from_color.q_wxyz + 4);
  pose.insert(pose.end(), depth_from_color.t_m, depth_from_color.t_m + 3);
  return {{"cameras.txt", "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]; 1: colour, 2: depth\n" +
                              lineOf(1, calibration.color_camera) + lineOf(2, calibration.depth_camera)},
          {"rigs.txt",
           "# RIG_ID, NUM_SENSORS, REF_SENSOR_TYPE, REF_SENSOR_ID, SENSORS[] as (SENSOR_TYPE, SENSOR_ID, "
           "HAS_POSE, [QW, QX, QY, QZ, TX, TY, TZ]); metres\n1 2 CAMERA 1 CAMERA 2 1 " +
               numbersText(pose, " ") + "\n"}};
}

}  // namespace sphc::host
