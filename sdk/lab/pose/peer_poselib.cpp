#include <memory>
#include <stdexcept>

#include "lab/common/coprocess.h"
#include "lab/pose/bench.h"
#include "lab/pose/peers.h"
#include "peer_poselib_script.h"

namespace sphc::host {
namespace {

constexpr size_t kFewestPoints = 4;

struct Request {
  uint32_t points, width_px, height_px, zero;
  uint64_t seed;
  double fx_px, fy_px, cx_px, cy_px;
};
static_assert(sizeof(Request) == 56);

struct Reply {
  double rotation[9], translation_m[3], seconds;
  uint32_t iterations, inliers, found, zero;
};
static_assert(sizeof(Reply) == 120);

bool send(Coprocess *process, const PoseCase &c, uint64_t seed) {
  static_assert(sizeof(Vector2) == 16 && sizeof(Vector3) == 24);
  const PinholeCamera &k = c.camera;
  const size_t count = c.true_points_map_m.size();
  const Request request = {
      static_cast<uint32_t>(count), k.width_px, k.height_px, 0, seed, k.fx_px, k.fy_px, k.cx_px, k.cy_px};
  return process->write(&request, sizeof request) &&
         process->write(c.true_pixels_px.data(), count * sizeof(Vector2)) &&
         process->write(c.true_points_map_m.data(), count * sizeof(Vector3));
}

PoseAnswer ask(Coprocess *process, const PoseCase &c, uint64_t seed) {
  if (c.true_points_map_m.size() < kFewestPoints) return {};
  Reply reply;
  if (!send(process, c, seed) || !process->read(&reply, sizeof reply))
    throw std::runtime_error("PoseLib's Python process stopped answering; run again, or without it by --no-peers");
  PoseAnswer answer;
  for (int i = 0; i < 9; ++i) answer.camera_from_map.rotation(i / 3, i % 3) = reply.rotation[i];
  for (int i = 0; i < 3; ++i) answer.camera_from_map.translation_m[i] = reply.translation_m[i];
  answer.iterations = reply.iterations;
  answer.inliers = reply.inliers;
  answer.found = reply.found != 0;
  answer.seconds = reply.seconds;
  return answer;
}

}  // namespace

PoseVariant poseLibPeer(const std::string &python) {
  const auto process = startScript(python, kPoseLibScript);
  if (!process)
    return {kPoseLibName, true, nullptr,
            "not found by " + python + ": pip install poselib numpy, and name that Python with --python"};
  return {kPoseLibName, true, [process](const PoseCase &c, uint64_t seed) { return ask(process.get(), c, seed); },
          ""};
}

}  // namespace sphc::host
