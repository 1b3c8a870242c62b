#include <algorithm>
#include <iterator>

#include "tests/fuzz/arguments.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

constexpr uint64_t kMostBytes = 8u << 20;  // a larger localizer is measured but not made
constexpr uint32_t kFrames = 3, kMostPieces = 1000;

// Writes some fields anew.  Every field lies at a multiple of four bytes.
template <typename T>
void disturb(T *its, Reader *reader) {
  constexpr uint32_t kWords = sizeof(T) / 4;
  static_assert(kWords <= 256);
  auto *bytes = reinterpret_cast<uint8_t *>(its);
  for (uint32_t left = reader->next() % 4; left > 0; --left) {
    const uint32_t word = reader->next() % kWords;
    uint32_t whole;
    std::memcpy(&whole, bytes + 4 * word, sizeof whole);
    const double number = word % 2 == 0 && word + 1 < kWords ? anyNumber(reader) : 0;
    if (number != 0)
      std::memcpy(bytes + 4 * word, &number, sizeof number);
    else
      std::memcpy(bytes + 4 * word, &(whole = around(whole + reader->next() % 4, reader)), sizeof whole);
  }
}

// Elements of a caller's array lie as far apart as the first one says, which may be any size that a struct may
// have.
template <typename T, uint32_t kMost>
struct Elements {
  alignas(8) uint8_t bytes[kMost * 4096] = {};

  const T *fill(const T &right, uint32_t count, Reader *reader) {
    for (uint32_t i = 0; i < std::min(count, kMost); ++i) {
      T element = right;
      disturb(&element, reader);
      std::memcpy(bytes + i * sizeof element, &element, sizeof element);
    }
    return reinterpret_cast<const T *>(bytes);
  }
};

void logNothing(void *, sphc_log_level, const char *, size_t) {}
int64_t tick(void *now_ns) { return *static_cast<int64_t *>(now_ns) += 1000; }

struct Config {
  Roomy<sphc_localizer_config> roomy;
  Elements<sphc_localizer_camera, SPHC_CAMERAS_MAX> cameras;
  Elements<sphc_localizer_depth_camera, SPHC_DEPTH_CAMERAS_MAX> depth_cameras;
  int64_t now_ns = 0;

  explicit Config(Reader *reader) {
    sphc_localizer_config &config = roomy.its;
    config = smallConfig();
    const uint8_t parts = reader->next();
    config.mode = parts & 1 ? SPHC_MODE_TRACKING : SPHC_MODE_SINGLE;
    config.camera_count = parts >> 1 & 1;
    config.depth_camera_count = parts >> 2 & 1;
    disturb(&config, reader);
    // Pointers lead somewhere or are null.
    config.log = parts & 8 ? logNothing : nullptr;
    config.log_user = nullptr;
    config.clock = parts & 16 ? tick : nullptr;
    config.clock_user = &now_ns;
    config.parallel = nullptr;
    config.parallel_user = nullptr;
    // An array where there are cameras, or the other way about.
    const bool has_cameras = (config.camera_count > 0) != ((parts & 32) != 0),
               has_depth_cameras = (config.depth_camera_count > 0) != ((parts & 64) != 0);
    config.cameras = has_cameras ? cameras.fill(camera(), config.camera_count, reader) : nullptr;
    config.depth_cameras =
        has_depth_cameras ? depth_cameras.fill(depthCamera(), config.depth_camera_count, reader) : nullptr;
    if (parts & 128) roomy.behind[reader->next()] = reader->next() % 2;
  }
  const sphc_localizer_config *get() const { return &roomy.its; }

 private:
  static sphc_localizer_camera camera() {
    sphc_localizer_camera made;
    sphc_localizer_camera_init(&made, sizeof made);
    made.camera = smallConfig().rig.color_camera;
    return made;
  }
  static sphc_localizer_depth_camera depthCamera() {
    sphc_localizer_depth_camera made;
    sphc_localizer_depth_camera_init(&made, sizeof made);
    made.camera = smallConfig().rig.depth_camera;
    return made;
  }
};

// What the config is told to take: a map and frames, of the small config's sizes.
struct Material {
  test::Session session{smallConfig(), 0.7};
  std::unique_ptr<test::SceneFrame> scene = test::sceneFrame(smallConfig(), 0);
};

void playFrames(sphc_localizer *localizer, const sphc_localizer_config &config, Material *material,
                Reader *reader) {
  sphc_localizer_set_map(localizer, 0, material->session.map());  // of another band: refused
  sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_MAX_ITERATIONS, 100);
  sphc_localizer_view views[SPHC_CAMERAS_MAX] = {};
  sphc_localizer_depth_view depth_views[SPHC_DEPTH_CAMERAS_MAX] = {};
  Roomy<sphc_localizer_prior> prior;
  sphc_localizer_frame frame = material->scene->frame;
  for (sphc_localizer_view &view : views) {
    view.struct_size = sizeof view;
    view.image = frame.color;
  }
  for (sphc_localizer_depth_view &view : depth_views) {
    view.struct_size = sizeof view;
    view.depth = frame.depth;
  }
  frame.views = config.camera_count ? views : nullptr;
  frame.view_count = std::min(config.camera_count, SPHC_CAMERAS_MAX);
  frame.depth_views = config.depth_camera_count ? depth_views : nullptr;
  frame.depth_view_count = std::min(config.depth_camera_count, SPHC_DEPTH_CAMERAS_MAX);
  for (uint32_t i = 0; i < kFrames; ++i) {
    frame.color_time_ns += 33000000;
    frame.depth_time_ns = frame.color_time_ns;
    prior.its = priorFrom(reader);
    frame.prior = reader->next() < 200 ? &prior.its : nullptr;
    sphc_localizer_result result = {};
    result.struct_size = sizeof result;
    const sphc_status status = sphc_localizer_process(localizer, &frame, &result);
    if (status >= 0 ? !isFilled(result) : !sphc_localizer_message(localizer)[0])
      broken("a frame has a finite answer, or a refusal that explains itself");
    if (status == SPHC_OK) accept();
  }
}

uint64_t accountOf(const sphc_localizer_config *config, uint32_t scratch) {
  uint64_t bytes = 0;
  sphc_memory_piece piece = {};
  for (uint32_t i = 0; sphc_localizer_memory_piece(config, i, &piece) == SPHC_OK; ++i) {
    if (i == kMostPieces || !piece.name) broken("an account of memory ends, and its pieces have names");
    if (piece.scratch == scratch) bytes += piece.bytes;
  }
  return bytes;
}

}  // namespace

void config(const uint8_t *data, size_t bytes) {
  static Material *material = new Material;
  Reader reader(data, bytes);
  const auto config = std::make_unique<Config>(&reader);
  sphc_memory need = {};
  sphc_message message = {};
  const sphc_status status = sphc_localizer_memory(config->get(), &need, &message);
  if (status != SPHC_OK) {
    if (status > 0 || !message.text[0]) broken("a refusal is a failure that explains itself");
    return;
  }
  if (accountOf(config->get(), 0) > need.state_bytes || accountOf(config->get(), 1) > need.scratch_bytes)
    broken("pieces are no more than the whole");
  if (need.state_bytes + need.scratch_bytes > kMostBytes) return;
  test::GuardedMemory state(need.state_bytes, need.alignment), scratch(need.scratch_bytes, need.alignment);
  sphc_localizer *localizer = nullptr;
  if (sphc_localizer_init(state.data(), state.size(), scratch.data(), scratch.size(), config->get(), &localizer,
                          &message) != SPHC_OK)
    broken("what can be measured can be made");
  playFrames(localizer, *config->get(), material, &reader);
  sphc_localizer_fini(&localizer);
  if (!state.guardsIntact() || !scratch.guardsIntact()) broken("the localizer keeps inside its memory");
}

}  // namespace sphc::fuzz
