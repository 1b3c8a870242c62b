#include "host/cameras/join.h"

#include <algorithm>
#include <stdexcept>

#include "host/cameras/fault.h"
#include "host/cameras/rigid_matrix.h"

namespace sphc::host {
namespace {

constexpr sphc_rigid kIdentity = {{1, 0, 0, 0}, {0, 0, 0}};

// A camera, with its part and its place among all.
struct Candidate {
  const NamedCamera *named;
  size_t part, place;
};

std::string namesOf(const std::vector<Candidate> &all) {
  std::string names;
  for (const Candidate &candidate : all) names += (names.empty() ? "" : ", ") + shown(candidate.named->name);
  return names;
}

const Candidate *findName(const std::vector<Candidate> &all, const std::string &name) {
  const Candidate *found = nullptr;
  for (const Candidate &candidate : all) {
    if (candidate.named->name != name) continue;
    if (found) throw std::runtime_error("these files have two cameras " + shown(name) + "; name one file of it");
    found = &candidate;
  }
  return found;
}

// By the wanted name, by the role as a name, by its place.
const Candidate &choose(const std::vector<Candidate> &all, const std::string &wanted, const std::string &role,
                        size_t place) {
  if (!wanted.empty()) {
    const Candidate *named = findName(all, wanted);
    if (!named)
      throw std::runtime_error("no camera " + shown(wanted) + " in these files; there are: " + namesOf(all));
    return *named;
  }
  if (const Candidate *named = findName(all, role)) return *named;
  if (all.size() > 2)
    throw std::runtime_error("these files have " + std::to_string(all.size()) + " cameras: " + namesOf(all) +
                             "; say with --color and --depth which to take");
  return all[place];
}

std::string sizeText(uint32_t width, uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

sphc_camera inMode(sphc_camera camera, const ImageMode &mode) {
  const double scale_x = static_cast<double>(mode.scaled_width) / camera.width;
  const double scale_y = static_cast<double>(mode.scaled_height) / camera.height;
  camera.params[0] *= scale_x;
  camera.params[1] *= scale_y;
  camera.params[2] = camera.params[2] * scale_x - mode.crop_x;
  camera.params[3] = camera.params[3] * scale_y - mode.crop_y;
  camera.width = mode.width;
  camera.height = mode.height;
  return camera;
}

sphc_camera resized(const NamedCamera &named, ImageSize size, const std::string &role) {
  sphc_camera camera = named.camera;
  const bool known = camera.width != 0 && camera.height != 0;
  if (size.width == 0 && !known)
    throw std::runtime_error("camera " + shown(named.name) + ": the file does not say the image's size; give --" +
                             role + "-size WIDTHxHEIGHT");
  if (size.width == 0) return camera;
  // One side may be known alone.
  const bool other_width = camera.width != 0 && camera.width != size.width;
  if (!known && (other_width || (camera.height != 0 && camera.height != size.height)))
    throw std::runtime_error(role + " images of " + sizeText(size.width, size.height) + ": the file gives camera " +
                             shown(named.name) + (other_width ? " the width " : " the height ") +
                             std::to_string(other_width ? camera.width : camera.height) + "; give --" + role +
                             "-size of the images that it was calibrated with");
  if (!known) {
    camera.width = size.width;
    camera.height = size.height;
  }
  if (size.width == camera.width && size.height == camera.height) return camera;
  std::string sizes = sizeText(camera.width, camera.height);
  for (const ImageMode &mode : named.modes) {
    if (mode.width == size.width && mode.height == size.height) return inMode(camera, mode);
    sizes += ", " + sizeText(mode.width, mode.height);
  }
  throw std::runtime_error(role + " images of " + sizeText(size.width, size.height) + ": camera " +
                           shown(named.name) + " is calibrated for " + sizes + "; choose one of them");
}

sphc_rigid colorFromDepth(const std::vector<CalibrationPart> &parts, const JoinOptions &options,
                          const Candidate &color, const Candidate &depth) {
  if (options.color_from_depth) return *options.color_from_depth;
  const auto has_transform = [](const CalibrationPart &part) { return part.second_from_first.has_value(); };
  if (std::count_if(parts.begin(), parts.end(), has_transform) > 1)
    throw std::runtime_error("two of these files have R and T; name one of them");
  for (const CalibrationPart &part : parts) {
    if (!part.second_from_first) continue;
    if (color.place + depth.place != 1)
      throw std::runtime_error("R and T join the first two cameras; name the files of colour and depth first");
    return depth.place == 1 ? inverse(*part.second_from_first) : *part.second_from_first;
  }
  if (color.part == depth.part && color.named->camera_from_rig && depth.named->camera_from_rig) {
    const sphc_rigid rig_from_depth = inverse(*depth.named->camera_from_rig);
    sphc_rigid result;
    sphc_rigid_compose(&*color.named->camera_from_rig, &rig_from_depth, &result);
    return result;
  }
  throw std::runtime_error(
      "no file says where the depth camera is; name one with R and T (x_2 = R x_1 + T, metres), "
      "or give --color-from-depth QW,QX,QY,QZ,TX,TY,TZ");
}

void requireExact(const NamedCamera &named, bool approximate) {
  if (named.inexact.empty() || approximate) return;
  throw std::runtime_error("camera " + shown(named.name) + ": " + named.inexact + "; take it with --approximate");
}

}  // namespace

sphc_rig joinParts(const std::vector<CalibrationPart> &parts, const JoinOptions &options) {
  std::vector<Candidate> all;
  sphc_rig result;
  sphc_rig_init(&result);
  for (size_t i = 0; i < parts.size(); ++i) {
    for (const NamedCamera &named : parts[i].cameras) all.push_back({&named, i, all.size()});
    if (parts[i].depth_unit_m) result.depth_unit_m = *parts[i].depth_unit_m;
  }
  if (all.empty()) throw std::runtime_error("these files have no camera; name one that has");
  if (all.size() == 1 && !options.registered)
    throw std::runtime_error(
        "these files have one camera: " + namesOf(all) +
        "; name the file of the other too, or say --registered if depth lies on colour already");

  const Candidate &color = choose(all, options.color, "color", 0);
  const Candidate &depth = options.registered ? color : choose(all, options.depth, "depth", 1);
  if (&color == &depth && !options.registered)
    throw std::runtime_error("camera " + shown(color.named->name) +
                             " cannot be both; say with --color and --depth which is which");
  requireExact(*color.named, options.approximate);
  requireExact(*depth.named, options.approximate);
  result.color_camera = resized(*color.named, options.color_size, "color");
  result.depth_camera =
      options.registered ? result.color_camera : resized(*depth.named, options.depth_size, "depth");
  result.color_from_depth = options.registered ? kIdentity : colorFromDepth(parts, options, color, depth);
  if (options.depth_unit_m) result.depth_unit_m = *options.depth_unit_m;

  sphc_message message = {};
  if (sphc_rig_check(&result, &message) < 0) throw std::runtime_error(message.text);
  return result;
}

}  // namespace sphc::host
