#include "drivers/simulated/cameras.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <string>

#include "drivers/simulated/config.h"
#include "drivers/simulated/raster.h"

namespace sphc::simulated {
namespace {

constexpr float kVignettingOfSmallLenses = 0.45f, kVignettingOfFisheyes = 0.12f;

constexpr bool isCutInTiles(uint32_t width) { return width % kTile == 0 && kTile % kLanes == 0; }

template <uint32_t Width, uint32_t Height>
sphc_camera makeCamera(sphc_camera_model model, std::initializer_list<double> params) {
  static_assert(isCutInTiles(Width), "images are cut in tiles");
  sphc_camera result{};
  result.model = model;
  result.width = Width;
  result.height = Height;
  result.param_count = static_cast<uint32_t>(params.size());
  std::copy(params.begin(), params.end(), result.params);
  return result;
}

sphc_rigid turned(double x, double y, double z, const double (&translation_m)[3]) {
  const double scale = 1 / std::sqrt(1 + x * x + y * y + z * z);
  return {{scale, x * scale, y * scale, z * scale}, {translation_m[0], translation_m[1], translation_m[2]}};
}

// About one degree down, half a degree to the left, a little roll: as two parts on one bracket are.
Cameras headsetCameras() {
  return {{makeCamera<SPHC_SIMULATED_COLOR_WIDTH, SPHC_SIMULATED_COLOR_HEIGHT>(
               SPHC_CAMERA_BROWN5, {520.4, 519.7, 322.3, 238.6, -0.052, 0.021, 0.0005, -0.0004, -0.002}),
           makeCamera<SPHC_SIMULATED_DEPTH_WIDTH, SPHC_SIMULATED_DEPTH_HEIGHT>(
               SPHC_CAMERA_KANNALA_BRANDT4, {232.6, 232.9, 158.4, 145.3, 0.018, -0.011, 0.004, -0.001}),
           turned(-0.0096, 0.0047, 0.0031, {0.0382, -0.0041, 0.0063}), SPHC_SIMULATED_DEPTH_UNIT_M},
          kVignettingOfSmallLenses,
          false};
}

// Colour is fine and depth coarse, smoothed, and given as of the colour camera.
Cameras phoneCameras() {
  constexpr double kFocal = 1086.3, kX = 722.1, kY = 537.4, kShrunk = 256.0 / 1440;
  return {{makeCamera<1440, 1080>(SPHC_CAMERA_BROWN5, {kFocal, kFocal, kX, kY, 0, 0, 0, 0, 0}),
           makeCamera<256, 192>(SPHC_CAMERA_BROWN5,
                                {kFocal * kShrunk, kFocal * kShrunk, kX * kShrunk, kY * kShrunk, 0, 0, 0, 0, 0}),
           turned(0, 0, 0, {0, 0, 0}), SPHC_SIMULATED_DEPTH_UNIT_M},
          kVignettingOfSmallLenses,
          true};
}

// Two fisheyes, 111 and 100 degrees wide.
Cameras wideCameras() {
  return {{makeCamera<640, 480>(SPHC_CAMERA_KANNALA_BRANDT4,
                                {331.2, 330.8, 318.4, 242.9, 0.011, -0.006, 0.003, -0.001}),
           makeCamera<320, 288>(SPHC_CAMERA_KANNALA_BRANDT4,
                                {184.1, 184.3, 161.2, 143.1, 0.014, -0.008, 0.002, -0.001}),
           turned(0.0121, -0.0034, -0.0052, {-0.0285, 0.0036, -0.0041}), SPHC_SIMULATED_DEPTH_UNIT_M},
          kVignettingOfFisheyes,
          false};
}

// Small parts: depth has 64 x 48 zones.
Cameras glassesCameras() {
  return {{makeCamera<480, 360>(SPHC_CAMERA_BROWN5,
                                {421.7, 421.2, 238.2, 181.8, -0.031, 0.012, 0.0003, 0.0006, -0.001}),
           makeCamera<64, 48>(SPHC_CAMERA_BROWN5, {51.8, 51.7, 32.3, 23.8, -0.02, 0, 0, 0, 0}),
           turned(0.0047, 0.0082, -0.0018, {0.0151, 0.0012, -0.0008}), SPHC_SIMULATED_DEPTH_UNIT_M},
          kVignettingOfSmallLenses,
          false};
}

// By their numbers.
constexpr struct {
  const char *name;
  Cameras (*make)();
} kKinds[] = {
    {"headset", headsetCameras}, {"phone", phoneCameras}, {"wide", wideCameras}, {"glasses", glassesCameras}};

static_assert(SPHC_SIMULATED_CAMERAS_HEADSET == 0 && SPHC_SIMULATED_CAMERAS_PHONE == 1 &&
              SPHC_SIMULATED_CAMERAS_WIDE == 2 && SPHC_SIMULATED_CAMERAS_GLASSES == 3);

std::string names() {
  std::string all;
  for (const auto &entry : kKinds) all += (all.empty() ? "" : ", ") + std::string(entry.name);
  return all;
}

}  // namespace

Cameras camerasOf(uint32_t kind) { return kKinds[kind].make(); }

sphc_status checkCameras(const sphc_simulated_config &config, sphc_message *message) {
  if (config.cameras >= std::size(kKinds)) {
    explain(message, "simulated: cameras is %u; set it to one of the SPHC_SIMULATED_CAMERAS_ numbers, which are %s",
            config.cameras, names().c_str());
    return SPHC_E_ARGUMENT;
  }
  if (config.raw_depth != 0 && camerasOf(config.cameras).smooths_depth) {
    explain(message, "simulated: raw_depth is 1, but a %s gives smoothed depth alone; choose other cameras",
            kKinds[config.cameras].name);
    return SPHC_E_ARGUMENT;
  }
  return SPHC_OK;
}

}  // namespace sphc::simulated

sphc_status sphc_simulated_parse_cameras(const char *name, uint32_t *cameras, sphc_message *message) {
  using namespace sphc::simulated;
  if (name == nullptr || cameras == nullptr) {
    explain(message, "simulated: the name or the place for its number is null; give both");
    return SPHC_E_ARGUMENT;
  }
  for (uint32_t kind = 0; kind < std::size(kKinds); ++kind) {
    if (std::strcmp(kKinds[kind].name, name) != 0) continue;
    *cameras = kind;
    return SPHC_OK;
  }
  explain(message, "simulated: cameras '%s' are unknown; there are %s", name, names().c_str());
  return SPHC_E_ARGUMENT;
}

const char *sphc_simulated_cameras_name(uint32_t cameras) {
  using namespace sphc::simulated;
  return cameras < std::size(kKinds) ? kKinds[cameras].name : "unknown";
}
