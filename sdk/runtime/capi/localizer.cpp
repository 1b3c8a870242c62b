#include <cstddef>
#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/config_copy.h"
#include "runtime/capi/defaults.h"
#include "runtime/capi/format.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/localizer_check.h"
#include "runtime/capi/objects.h"
#include "runtime/capi/parameters.h"
#include "runtime/capi/translate.h"

namespace {

using sphc::Arena;
using sphc::Localizer;
using sphc::LocalizerConfig;
using sphc::MemoryRange;
using sphc::MessageWriter;

constexpr size_t kLocalizerBytes = sizeof(sphc_localizer);  // a multiple of the arena's alignment

sphc_memory measure(const LocalizerConfig &config) {
  Arena state, scratch;
  Localizer::layout(config, state, scratch, nullptr);
  return {kLocalizerBytes + state.used(), scratch.used(), sphc::kArenaAlignment, 0};
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

sphc_status refuseMap(uint32_t map_id, sphc_message *message) {
  MessageWriter(message) << "the localizer has no map with id " << map_id
                         << "; give one that sphc_localizer_set_map was called with";
  return SPHC_E_ARGUMENT;
}

}  // namespace

sphc_status sphc_localizer_config_init(sphc_localizer_config *config, size_t struct_size) {
  return sphc::initStruct(sphc::defaultConfig(), struct_size, config);
}

sphc_status sphc_localizer_result_init(sphc_localizer_result *result, size_t struct_size) {
  return sphc::initStruct(sphc::emptyResult(), struct_size, result);
}

sphc_status sphc_localizer_frame_init(sphc_localizer_frame *frame, size_t struct_size) {
  return sphc::initStruct(sphc_localizer_frame(), struct_size, frame);
}

sphc_status sphc_localizer_prior_init(sphc_localizer_prior *prior, size_t struct_size) {
  return sphc::initStruct(sphc::emptyPrior(), struct_size, prior);
}

sphc_status sphc_localizer_camera_init(sphc_localizer_camera *camera, size_t struct_size) {
  return sphc::initStruct(sphc::emptyCamera(), struct_size, camera);
}

sphc_status sphc_localizer_view_init(sphc_localizer_view *view, size_t struct_size) {
  return sphc::initStruct(sphc_localizer_view(), struct_size, view);
}

sphc_status sphc_localizer_depth_camera_init(sphc_localizer_depth_camera *camera, size_t struct_size) {
  return sphc::initStruct(sphc::emptyDepthCamera(), struct_size, camera);
}

sphc_status sphc_localizer_depth_view_init(sphc_localizer_depth_view *view, size_t struct_size) {
  return sphc::initStruct(sphc_localizer_depth_view(), struct_size, view);
}

sphc_status sphc_localizer_prediction_init(sphc_localizer_prediction *prediction, size_t struct_size) {
  return sphc::initStruct(sphc::emptyPrediction(), struct_size, prediction);
}

sphc_status sphc_localizer_memory(const sphc_localizer_config *config, sphc_memory *memory, sphc_message *message) {
  sphc::ConfigCopy checked;
  const sphc_status status = sphc::readConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  return sphc::giveMemory(measure(sphc::localizerConfigFrom(checked.config)), memory, message);
}

sphc_status sphc_localizer_memory_piece(const sphc_localizer_config *config, uint32_t index,
                                        sphc_memory_piece *piece) {
  sphc::ConfigCopy checked;
  const sphc_status status = sphc::readConfig(config, &checked, nullptr);
  if (status != SPHC_OK) return status;
  if (!piece) return SPHC_E_ARGUMENT;
  if (index == 0) {
    *piece = {"localizer.object", kLocalizerBytes, 0, 0};
    return SPHC_OK;
  }
  const LocalizerConfig own = sphc::localizerConfigFrom(checked.config);
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
                                const sphc_localizer_config *config, sphc_localizer **localizer,
                                sphc_message *message) {
  sphc::ConfigCopy checked;
  sphc_status status = sphc::readConfig(config, &checked, message);
  if (status != SPHC_OK) return status;
  if (!localizer) {
    MessageWriter(message) << "localizer is null; give a pointer to set";
    return SPHC_E_ARGUMENT;
  }
  const LocalizerConfig own = sphc::localizerConfigFrom(checked.config);
  const sphc_memory need = measure(own);
  const MemoryRange used_state = {"state", state, static_cast<size_t>(need.state_bytes)},
                    used_scratch = {"scratch", scratch, static_cast<size_t>(need.scratch_bytes)};
  status = sphc::checkMemory(state, state_bytes, used_state.bytes, need.alignment, "state", message);
  if (status == SPHC_OK)
    status = sphc::checkMemory(scratch, scratch_bytes, used_scratch.bytes, need.alignment, "scratch", message);
  if (status == SPHC_OK) status = sphc::checkApart(used_state, used_scratch, message);
  if (status != SPHC_OK) return status;

  auto *made = new (state) sphc_localizer();
  Arena state_arena(static_cast<unsigned char *>(state) + kLocalizerBytes), scratch_arena(scratch);
  Localizer::layout(own, state_arena, scratch_arena, &made->localizer);
  made->localizer.init(own);
  made->state = used_state;
  made->scratch = used_scratch;
  made->max_keypoints = checked.config.max_keypoints;
  made->depth_formats[0] = sphc::depthFormatOf(checked.config.depth_format);
  for (uint32_t i = 0; i < checked.config.depth_camera_count; ++i)
    made->depth_formats[1 + i] = sphc::depthFormatOf(checked.config.depth_cameras[i].format);
  made->color_band = checked.config.color_band;
  made->has_clock = checked.config.clock != nullptr;
  made->log = checked.config.log;
  made->log_user = checked.config.log_user;
  made->log_level = checked.config.log_level;
  *localizer = made;
  return SPHC_OK;
}

void sphc_localizer_fini(sphc_localizer **localizer) {
  if (localizer) *localizer = nullptr;
}

sphc_status sphc_localizer_set_map(sphc_localizer *localizer, uint32_t map_id, const sphc_map *map) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  if (!map || map_id == SPHC_MAP_NONE) {
    MessageWriter(message) << (map ? "map_id is SPHC_MAP_NONE; give another"
                                   : "map is null; open one with sphc_map_init");
    return SPHC_E_ARGUMENT;
  }
  if (map->view.band() != localizer->color_band) {
    MessageWriter(message)
        << "the map is of " << sphc_band_name(map->view.band()) << ", and config.color_band is "
        << sphc_band_name(localizer->color_band)
        << "; give a map that was made of what this camera sees, or set color_band to what it is";
    return SPHC_E_ARGUMENT;
  }
  sphc_status status = sphc::checkApartFromMap(localizer->state, *map, message);
  if (status == SPHC_OK) status = sphc::checkApartFromMap(localizer->scratch, *map, message);
  if (status != SPHC_OK || localizer->localizer.setMap(map_id, map->view)) return status;
  MessageWriter(message) << "the localizer has " << localizer->localizer.maps().count()
                         << " maps, as many as config.max_maps; remove one, or raise it";
  return SPHC_E_CAPACITY;
}

sphc_status sphc_localizer_remove_map(sphc_localizer *localizer, uint32_t map_id) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  if (localizer->localizer.removeMap(map_id)) return SPHC_OK;
  return refuseMap(map_id, message);
}

sphc_status sphc_localizer_set_map_transform(sphc_localizer *localizer, uint32_t map_id,
                                             const sphc_rigid *common_from_map, double rotation_sigma_rad,
                                             double translation_sigma_m) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  sphc::Placement placement;
  if (common_from_map) {
    const sphc_status status =
        sphc::checkPlacement(*common_from_map, rotation_sigma_rad, translation_sigma_m, message);
    if (status != SPHC_OK) return status;
    placement = {true, sphc::rigidFromC(*common_from_map), rotation_sigma_rad, translation_sigma_m};
  }
  if (localizer->localizer.placeMap(map_id, placement)) return SPHC_OK;
  return refuseMap(map_id, message);
}

uint32_t sphc_localizer_map_count(const sphc_localizer *localizer) {
  return localizer ? localizer->localizer.maps().count() : 0;
}

sphc_status sphc_localizer_get_parameter_range(sphc_localizer_parameter parameter,
                                               sphc_localizer_parameter_range *range) {
  uint32_t struct_size = 0;
  sphc_status status = sphc::checkParameter(parameter, nullptr);
  if (status == SPHC_OK) status = sphc::checkStruct("range", range, nullptr, &struct_size);
  if (status == SPHC_OK) sphc::writeStruct(sphc::rangeOf(parameter), struct_size, range);
  return status;
}

sphc_status sphc_localizer_set_parameter(sphc_localizer *localizer, sphc_localizer_parameter parameter,
                                         double value) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  sphc::SearchParameters parameters = localizer->localizer.parameters();
  sphc_status status = sphc::checkParameter(parameter, message);
  if (status == SPHC_OK) status = sphc::setValue(parameter, value, &parameters, message);
  if (status == SPHC_OK) localizer->localizer.setParameters(parameters);
  return status;
}

sphc_status sphc_localizer_get_parameter(const sphc_localizer *localizer, sphc_localizer_parameter parameter,
                                         double *value) {
  if (!localizer || !value) return SPHC_E_ARGUMENT;
  const sphc_status status = sphc::checkParameter(parameter, nullptr);
  if (status == SPHC_OK) *value = sphc::valueOf(localizer->localizer.parameters(), parameter);
  return status;
}

sphc_status sphc_localizer_set_depth_bias(sphc_localizer *localizer, const sphc_depth_bias *depth) {
  if (!localizer) return SPHC_E_ARGUMENT;
  sphc_message *message = localizer->beginCall();
  const sphc_status status = sphc::checkDepthBias(depth, localizer->localizer.depthPrior(), message);
  if (status == SPHC_OK) localizer->localizer.setDepth(sphc::depthCalibrationFrom(*depth));
  return status;
}

void sphc_localizer_reset(sphc_localizer *localizer) {
  if (!localizer) return;
  localizer->localizer.reset();
  localizer->logged_faults = localizer->logged = localizer->stuck = 0;
}

const char *sphc_localizer_message(const sphc_localizer *localizer) {
  return localizer ? localizer->message.text : "localizer is null";
}
