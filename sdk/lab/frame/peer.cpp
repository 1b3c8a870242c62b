#include "lab/frame/peer.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lab/common/coprocess.h"
#include "peer_script.h"

namespace sphc::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPatienceS = 900;  // an index of a million points takes minutes
constexpr uint32_t kMostReplyBytes = 1u << 20;
constexpr uint32_t kMappingKeypoints = 1200;  // of a mapping frame, as `spherecloud build` takes
constexpr double kNoStage = std::numeric_limits<double>::quiet_NaN();

struct Payload {
  const void *data;
  size_t bytes;
};

bool isTight(const sphc_image &image, uint32_t pixel_bytes) {
  return image.stride_bytes == image.width * pixel_bytes;
}

std::vector<Payload> imagesOf(const sphc_localizer_frame &frame) {
  if (frame.color.format != SPHC_FORMAT_BGR8 || !isTight(frame.color, 3) || !isTight(frame.depth, 2))
    throw std::runtime_error("peers need BGR images without gaps between rows; leave them out with --no-peers");
  return {{frame.color.data, size_t{3} * frame.color.width * frame.color.height},
          {frame.depth.data, size_t{2} * frame.depth.width * frame.depth.height}};
}

Json cameraJson(const sphc_camera &camera) {
  if (camera.model == SPHC_CAMERA_KANNALA_BRANDT4)
    throw std::runtime_error("peers know pinhole and Brown cameras, not fisheyes; leave them out with --no-peers");
  const std::vector<double> params(camera.params, camera.params + camera.param_count);
  return {{"size", {camera.width, camera.height}}, {"params", params}};
}

std::vector<double> rowMajor(const Matrix3 &m) {
  std::vector<double> values;
  for (int i = 0; i < 9; ++i) values.push_back(m(i / 3, i % 3));
  return values;
}

Json rigidJson(const Rigid &rigid) {
  const Vector3 &t = rigid.translation_m;
  return {{"rotation", rowMajor(rigid.rotation)}, {"translation_m", {t.x(), t.y(), t.z()}}};
}

FrameAnswer answerOf(const Json &reply) {
  FrameAnswer answer;
  answer.stages[kFeatures] = reply.at("features_s").get<double>();
  answer.stages[kAlign] = kNoStage;
  answer.stages[kMatch] = reply.at("match_s").get<double>();
  answer.stages[kPose] = reply.at("pose_s").get<double>();
  answer.pose.seconds = answer.stages[kFeatures] + answer.stages[kMatch] + answer.stages[kPose];
  answer.pose.found = reply.at("found").get<bool>();
  if (!answer.pose.found) return answer;
  answer.pose.inliers = reply.at("inliers").get<uint32_t>();
  for (int i = 0; i < 9; ++i)
    answer.pose.camera_from_map.rotation(i / 3, i % 3) =
        reply.at("rotation").at(static_cast<size_t>(i)).get<double>();
  for (int i = 0; i < 3; ++i)
    answer.pose.camera_from_map.translation_m[i] =
        reply.at("translation_m").at(static_cast<size_t>(i)).get<double>();
  return answer;
}

}  // namespace

struct FramePeers::Conversation {
  Coprocess process;

  explicit Conversation(const std::string &python) : process({python, "-c", kFramePeerScript}, kPatienceS) {}

  Json ask(Json message, const std::vector<Payload> &payloads = {}) {
    size_t bytes = 0;
    for (const Payload &payload : payloads) bytes += payload.bytes;
    message["payload"] = bytes;
    const std::string text = message.dump();
    const uint32_t length = static_cast<uint32_t>(text.size());
    bool sent = process.write(&length, sizeof length) && process.write(text.data(), text.size());
    for (const Payload &payload : payloads) sent = sent && process.write(payload.data, payload.bytes);
    const Json reply = sent ? receive() : Json();
    if (reply.is_null())
      throw std::runtime_error(
          "the peers' Python process stopped answering; run again, or without it by --no-peers");
    if (reply.contains("error"))
      throw std::runtime_error("the peers' Python process failed: " + reply.at("error").get<std::string>());
    return reply;
  }

 private:
  Json receive() {
    uint32_t length = 0;
    if (!process.read(&length, sizeof length) || length > kMostReplyBytes) return nullptr;
    std::string text(length, '\0');
    if (!process.read(text.data(), text.size())) return nullptr;
    return Json::parse(text, nullptr, false);
  }
};

FramePeers::FramePeers(const std::string &python) {
  try {
    conversation_ = std::make_shared<Conversation>(python);
    const Json greeting = conversation_->ask({{"do", "greet"}});
    for (const Json &variant : greeting.at("variants"))
      variants_.push_back(
          {variant.at("name").get<std::string>(), nullptr, variant.at("absent").get<std::string>(), {}});
    for (const auto &[package, version] : greeting.at("versions").items())
      packages_ += (packages_.empty() ? "" : ", ") + package + " " + version.get<std::string>();
  } catch (const std::exception &) {
    conversation_ = nullptr;
    variants_ = {{"package peers", nullptr, python + " does not run; name a Python 3 with --python", {}}};
  }
  for (uint32_t i = 0; conversation_ && i < variants_.size(); ++i) {
    if (!variants_[i].absent.empty()) continue;
    variants_[i].run = [conversation = conversation_, i](const FrameCase &frame, uint32_t repeat) {
      const Json message = {{"do", "query"}, {"variant", i}, {"frame", frame.index}, {"seed", 1 + repeat}};
      return answerOf(conversation->ask(message, imagesOf(frame.image)));
    };
  }
}

void FramePeers::begin(const sphc_localizer_config &config, const std::vector<std::string> &chosen) {
  chosen_.clear();
  for (uint32_t i = 0; i < variants_.size(); ++i)
    if (std::find(chosen.begin(), chosen.end(), variants_[i].name) != chosen.end()) chosen_.push_back(i);
  conversation_->ask({{"do", "begin"},
                      {"variants", chosen_},
                      {"keypoints", config.max_keypoints},
                      {"mapping_keypoints", kMappingKeypoints},
                      {"color", cameraJson(config.rig.color_camera)},
                      {"depth", cameraJson(config.rig.depth_camera)},
                      {"color_from_depth", rigidJson(rigidFromC(config.rig.color_from_depth))},
                      {"depth_unit_m", config.rig.depth_unit_m},
                      {"depth_min_m", config.depth_min_m},
                      {"depth_max_m", config.depth_max_m}});
}

void FramePeers::addMappingFrame(const sphc_localizer_frame &frame, const Rigid &world_from_camera) {
  Json message = rigidJson(world_from_camera);
  message["do"] = "map";
  conversation_->ask(message, imagesOf(frame));
}

uint32_t FramePeers::index(uint32_t points) {
  const Json reply = conversation_->ask({{"do", "index"}, {"variants", chosen_}, {"points", points}});
  uint32_t fewest = points;
  for (const auto &own : reply.at("own")) fewest = std::min(fewest, own.get<uint32_t>());
  return fewest;
}

}  // namespace sphc::host
