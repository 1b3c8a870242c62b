#include <memory>
#include <stdexcept>

#include "lab/common/coprocess.h"
#include "lab/features/variant.h"
#include "peer_colmap_script.h"

namespace sphc::host {
namespace {

constexpr uint32_t kSiftBytes = 128, kMostKeypoints = 100000;

struct Reply {
  uint32_t count, zero;
  double seconds;
};
static_assert(sizeof(Reply) == 16);

bool send(Coprocess *process, const GrayView &image) {
  const uint32_t size[2] = {static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height)};
  bool sent = process->write(size, sizeof size);
  for (int32_t y = 0; y < image.height && sent; ++y) sent = process->write(image.row(y), size[0]);
  return sent;
}

FoundFeatures ask(Coprocess *process, const GrayView &image) {
  Reply reply = {};
  std::vector<float> places, histograms;
  bool answered = send(process, image) && process->read(&reply, sizeof reply) && reply.count <= kMostKeypoints;
  if (answered) {
    places.resize(2 * size_t{reply.count});
    histograms.resize(kSiftBytes * size_t{reply.count});
    answered = process->read(places.data(), places.size() * sizeof(float)) &&
               process->read(histograms.data(), histograms.size() * sizeof(float));
  }
  if (!answered)
    throw std::runtime_error("COLMAP's Python process stopped answering; run again, or without it by --no-peers");
  FoundFeatures found;
  found.seconds = reply.seconds;
  for (size_t i = 0; i < reply.count; ++i) {
    found.pixels_px.emplace_back(static_cast<double>(places[2 * i]), static_cast<double>(places[2 * i + 1]));
    appendRootSift(&histograms[kSiftBytes * i], &found.descriptors);
  }
  return found;
}

}  // namespace

FeaturesVariant colmapFeatures(const std::string &python) {
  const char *name = "colmap sift 1000";
  const auto process = startScript(python, kColmapScript);
  if (!process)
    return {name, kSiftBytes, false, nullptr,
            "not found by " + python + ": pip install pycolmap numpy, and name that Python with --python"};
  return {name, kSiftBytes, false, [process](const GrayView &image) { return ask(process.get(), image); }, ""};
}

}  // namespace sphc::host
