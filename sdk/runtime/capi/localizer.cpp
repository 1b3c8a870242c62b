#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"
#include "runtime/capi/translate.h"

namespace {

using sphc::Arena;
using sphc::Localizer;
using sphc::LocalizerConfig;
using sphc::MemoryRange;

constexpr size_t kObjectBytes = sizeof(sphc_localizer);  // a multiple of the arena's alignment

sphc_memory measure(const LocalizerConfig &config) {
  Arena state, scratch;
  Localizer::layout(config, state, scratch, nullptr);
  return {kObjectBytes + state.used(), scratch.used(), sphc::kArenaAlignment};
}

// Finds the index-th piece of the layout walk.
struct PieceSearch {
  uint32_t wanted, seen;
  bool scratch;
  sphc_memory_piece *piece;
  bool found;

  static void visit(void *user, const char *name, size_t bytes) {
    auto *search = static_cast<PieceSearch *>(user);
    if (search->seen++ != search->wanted) return;
    *search->piece = {name, bytes, search->scratch, 0};
    search->found = true;
  }
};

void logResult(const sphc_localizer &localizer, const sphc_result &result) {
  if (!localizer.log) return;
  sphc_message text;
  sphc::MessageWriter(&text) << "frame " << result.sequence << ": "
                             << (result.outcome == SPHC_OUTCOME_LOCALIZED ? "localized" : "not localized")
                             << ", outcome " << result.outcome << ", keypoints " << result.keypoints << ", lifted "
                             << result.lifted << ", matches " << result.matches << ", inliers " << result.inliers
                             << ", state " << result.state << ", map " << result.map_index << ", hints "
                             << result.hints;
  size_t length = 0;
  while (text.text[length]) ++length;
  localizer.log(localizer.log_user, SPHC_LOG_DEBUG, text.text, length);
}

}  // namespace

sphc_status sphc_config_init(sphc_config *config, size_t struct_size) {
  return sphc::initStruct(sphc::defaultConfig(), struct_size, config);
}

sphc_status sphc_localizer_memory(const sphc_config *config, sphc_memory *memory, sphc_message *message) {
  sphc_config checked;
  const sphc_status status = sphc::readConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  if (!memory) {
    sphc::MessageWriter(message) << "memory is null";
    return SPHC_E_ARGUMENT;
  }
  *memory = measure(sphc::localizerConfigFrom(checked));
  return SPHC_OK;
}

sphc_status sphc_localizer_memory_piece(const sphc_config *config, uint32_t index, sphc_memory_piece *piece) {
  sphc_config checked;
  const sphc_status status = sphc::readConfig(config, &checked, nullptr);
  if (status != SPHC_OK) return status;
  if (!piece) return SPHC_E_ARGUMENT;
  if (index == 0) {
    *piece = {"localizer.object", kObjectBytes, 0, 0};
    return SPHC_OK;
  }
  const LocalizerConfig own = sphc::localizerConfigFrom(checked);
  PieceSearch in_state = {index - 1, 0, false, piece, false};
  Arena state(&PieceSearch::visit, &in_state), unseen;
  Localizer::layout(own, state, unseen, nullptr);
  if (in_state.found) return SPHC_OK;
  PieceSearch in_scratch = {index - 1 - in_state.seen, 0, true, piece, false};
  Arena unseen_state, scratch(&PieceSearch::visit, &in_scratch);
  Localizer::layout(own, unseen_state, scratch, nullptr);
  return in_scratch.found ? SPHC_OK : SPHC_END;
}

sphc_status sphc_localizer_init(void *state, size_t state_bytes, void *scratch, size_t scratch_bytes,
                                const sphc_config *config, const sphc_map *const *maps, uint32_t map_count,
                                sphc_localizer **localizer, sphc_message *message) {
  sphc_config checked;
  sphc_status status = sphc::readConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  status = sphc::checkMaps(maps, map_count, message);
  if (status != SPHC_OK) return status;
  if (!localizer) {
    sphc::MessageWriter(message) << "localizer is null";
    return SPHC_E_ARGUMENT;
  }
  const LocalizerConfig own = sphc::localizerConfigFrom(checked);
  const sphc_memory need = measure(own);
  status = sphc::checkMemory(state, state_bytes, need.state_bytes, need.alignment, "state", message);
  if (status != SPHC_OK) return status;
  status = sphc::checkMemory(scratch, scratch_bytes, need.scratch_bytes, need.alignment, "scratch", message);
  if (status != SPHC_OK) return status;
  const MemoryRange used_state = {"state", state, need.state_bytes},
                    used_scratch = {"scratch", scratch, need.scratch_bytes};
  status = sphc::checkApart(used_state, used_scratch, message);
  if (status == SPHC_OK) status = sphc::checkApartFromMaps(used_state, maps, map_count, message);
  if (status == SPHC_OK) status = sphc::checkApartFromMaps(used_scratch, maps, map_count, message);
  if (status != SPHC_OK) return status;

  auto *made = new (state) sphc_localizer();
  Arena state_arena(static_cast<unsigned char *>(state) + kObjectBytes), scratch_arena(scratch);
  Localizer::layout(own, state_arena, scratch_arena, &made->localizer);
  made->localizer.init(own);
  made->color = checked.rig.color_camera;
  made->depth = checked.rig.depth_camera;
  made->has_clock = checked.clock != nullptr;
  made->log = checked.log;
  made->log_user = checked.log_user;
  for (uint32_t i = 0; i < map_count; ++i) made->localizer.addMap(maps[i]->view);
  *localizer = made;
  return SPHC_OK;
}

void sphc_localizer_fini(sphc_localizer **localizer) {
  if (localizer) *localizer = nullptr;
}

void sphc_localizer_reset(sphc_localizer *localizer) {
  if (localizer) localizer->localizer.reset();
}

sphc_status sphc_localizer_process(sphc_localizer *localizer, const sphc_frame *frame, sphc_result *result) {
  if (!localizer) return SPHC_E_ARGUMENT;
  localizer->message.text[0] = '\0';
  sphc::FrameCopy copy;
  sphc_status status = sphc::readFrame(
      frame, {localizer->color, localizer->depth, localizer->localizer.mapCount(), localizer->has_clock}, &copy,
      &localizer->message);
  if (status == SPHC_OK) status = sphc::checkWritable("result", result, &localizer->message);
  if (status != SPHC_OK) return status;
  const sphc_result own = sphc::resultFrom(localizer->localizer.process(sphc::frameFrom(copy.frame)), copy.frame);
  sphc::writeStruct(own, result);
  logResult(*localizer, own);
  return own.outcome == SPHC_OUTCOME_LOCALIZED ? SPHC_OK : SPHC_NOT_LOCALIZED;
}

const char *sphc_localizer_message(const sphc_localizer *localizer) {
  return localizer ? localizer->message.text : "localizer is null";
}

double sphc_result_confidence(const sphc_result *result, double translation_m, double rotation_rad) {
  if (!result || result->outcome != SPHC_OUTCOME_LOCALIZED) return 0;
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(result->covariance);
  return sphc::Localizer::confidenceWithin(covariance, translation_m, rotation_rad);
}

sphc_status sphc_localizer_observations(const sphc_localizer *localizer, sphc_observation *observations,
                                        uint32_t capacity, uint32_t *count) {
  if (!localizer || !count || (capacity && !observations)) return SPHC_E_ARGUMENT;
  const sphc::Span<const sphc::Observation> seen = localizer->localizer.observations();
  for (uint32_t i = 0; i < capacity && i < seen.size(); ++i) observations[i] = sphc::observationFrom(seen[i]);
  *count = static_cast<uint32_t>(seen.size());
  return SPHC_OK;
}
