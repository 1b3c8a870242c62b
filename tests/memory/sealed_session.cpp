// A whole session through the C interface while the heap is sealed: from sphc_map_init to sphc_map_fini nothing may
// allocate. sealed_session --break CALL makes a forbidden call instead, to show that the seal holds.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "spherecloud/spherecloud_capture.h"
#include "tests/memory/sealed_heap.h"
#include "tests/support/session.h"

namespace {

using sphc::test::GuardedMemory;

void *volatile keep = nullptr;  // hides the calls below from the optimiser

int breakSeal(const char *call) {
  void *held = std::malloc(8);
  auto *object = new int(3);
  keep = held;
  sphc::test::sealHeap();
  if (!std::strcmp(call, "malloc")) keep = std::malloc(16);
  if (!std::strcmp(call, "calloc")) keep = std::calloc(2, 8);
  if (!std::strcmp(call, "free")) std::free(held);
  if (!std::strcmp(call, "new")) keep = ::operator new(16);
  if (!std::strcmp(call, "delete")) ::operator delete(object);
  return 0;
}

struct Everything {
  sphc_localizer_config config = sphc::test::sceneConfig();
  sphc::test::SceneMap map = sphc::test::makeSceneMap(config.rig.color_camera, config.max_keypoints, 3, 0.5);
  std::vector<std::unique_ptr<sphc::test::SceneFrame>> frames;
  sphc_aligner_config aligning = {};
  GuardedMemory map_memory, state, scratch, features_memory, pairer_memory, aligner_memory;
  std::vector<sphc_localizer_observation> observations =
      std::vector<sphc_localizer_observation>(config.max_keypoints);

  Everything() {
    for (uint32_t viewpoint = 0; viewpoint < 4; ++viewpoint)
      frames.push_back(sphc::test::sceneFrame(config, viewpoint));
    sphc_memory need = {};
    sphc_map_memory(&need);
    map_memory = GuardedMemory(need.state_bytes, need.alignment);
    sphc_pairer_memory(&need);
    pairer_memory = GuardedMemory(need.state_bytes, need.alignment);
    sphc_aligner_config_init(&aligning, sizeof aligning);
    aligning.rig = config.rig;
    sphc_aligner_memory(&aligning, &need, nullptr);
    aligner_memory = GuardedMemory(need.state_bytes, need.alignment);
    sphc_localizer_memory(&config, &need, nullptr);
    state = GuardedMemory(need.state_bytes, need.alignment);
    scratch = GuardedMemory(need.scratch_bytes, need.alignment);
    sphc_features_memory(&config, &need, nullptr);
    features_memory = GuardedMemory(need.state_bytes, need.alignment);
  }
};

bool runPairer(Everything *e) {
  sphc_pairer_config config;
  sphc_pairer *pairer = nullptr;
  sphc_message message = {};
  bool ok =
      sphc_pairer_config_init(&config, sizeof config) == SPHC_OK &&
      sphc_pairer_init(e->pairer_memory.data(), e->pairer_memory.size(), &config, &pairer, &message) == SPHC_OK;
  for (sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    capture.stream = stream;
    ok = ok && sphc_pairer_push(pairer, &capture) == SPHC_OK;
  }
  sphc_capture color = {}, depth = {}, dropped = {};
  ok = ok && sphc_pairer_pop(pairer, &color, &depth, &dropped) == SPHC_OK;
  sphc_pairer_flush(pairer);
  sphc_pairer_fini(&pairer);
  return ok;
}

bool runAligner(Everything *e) {
  sphc_aligner *aligner = nullptr;
  sphc_message message = {};
  sphc_memory need = {};
  const sphc_aligned nowhere = {sizeof nowhere, 0, 0, 0, nullptr, nullptr, nullptr};
  const bool ok = sphc_aligner_memory(&e->aligning, &need, &message) == SPHC_OK &&
                  sphc_aligner_init(e->aligner_memory.data(), e->aligner_memory.size(), &e->aligning, &aligner,
                                    &message) == SPHC_OK &&
                  sphc_aligner_process(aligner, &e->frames[0]->frame.depth, &nowhere) == SPHC_OK &&
                  sphc_aligner_process(aligner, &e->frames[0]->frame.color, &nowhere) == SPHC_E_IMAGE;
  sphc_aligner_fini(&aligner);
  return ok;
}

// A frame in two halves, and features that come from elsewhere.
bool runHalves(Everything *e, sphc_localizer *localizer, const sphc_localizer_frame &frame) {
  sphc_features *features = nullptr;
  sphc_message message = {};
  sphc_memory need = {};
  sphc_localizer_result result = {};
  sphc_features_arrays arrays = {};
  result.struct_size = sizeof result;
  arrays.struct_size = sizeof arrays;
  bool ok = sphc_features_memory(&e->config, &need, &message) == SPHC_OK &&
            sphc_features_init(e->features_memory.data(), e->features_memory.size(), &e->config, &features,
                               &message) == SPHC_OK &&
            sphc_localizer_extract(localizer, &frame, features) == SPHC_OK &&
            sphc_localizer_locate(localizer, &frame, features, &result) == SPHC_OK &&
            sphc_features_get(features, &arrays) == SPHC_OK &&
            sphc_features_set(features, &frame, &arrays) == SPHC_OK &&
            sphc_localizer_locate(localizer, &frame, features, &result) == SPHC_OK;
  arrays.extractor += 1;  // the way of a failure
  ok = ok && sphc_features_set(features, &frame, &arrays) == SPHC_E_MAP_EXTRACTOR;
  sphc_features_fini(&features);
  return ok;
}

// Number of frames localized, or -1.
int runSession(Everything *e) {
  sphc_map *map = nullptr;
  sphc_localizer *localizer = nullptr;
  sphc_message message = {};
  sphc_memory need = {};
  sphc_memory_piece piece = {};
  if (sphc_map_init(e->map_memory.data(), e->map_memory.size(), e->map.file.data(), e->map.file.size(), &map,
                    &message) != SPHC_OK ||
      sphc_localizer_memory(&e->config, &need, &message) != SPHC_OK ||
      sphc_localizer_memory_piece(&e->config, 3, &piece) != SPHC_OK ||
      sphc_localizer_init(e->state.data(), e->state.size(), e->scratch.data(), e->scratch.size(), &e->config,
                          &localizer, &message) != SPHC_OK ||
      sphc_localizer_set_map(localizer, 7, map) != SPHC_OK ||
      sphc_localizer_set_parameter(localizer, SPHC_PARAMETER_PROBES, 6) != SPHC_OK)
    return -1;
  int localized = 0;
  for (const auto &frame : e->frames) {
    sphc_localizer_result result = {};
    result.struct_size = sizeof result;
    uint32_t count = 0;
    localized += sphc_localizer_process(localizer, &frame->frame, &result) == SPHC_OK;
    sphc_localizer_observations(localizer, e->observations.data(), sizeof e->observations[0],
                                e->config.max_keypoints, &count);
    sphc_localizer_frame bad = frame->frame;  // the way of a failure, message included
    bad.color.width = 1;
    if (sphc_localizer_process(localizer, &bad, &result) != SPHC_E_IMAGE) return -1;
    if (!runHalves(e, localizer, frame->frame)) return -1;
  }
  sphc_localizer_fini(&localizer);
  sphc_map_fini(&map);
  return localized;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc == 3) return breakSeal(argv[2]);
  Everything everything;
  sphc::test::sealHeap();
  const int localized = runSession(&everything);
  const bool paired = runPairer(&everything);
  const bool aligned = runAligner(&everything);
  sphc::test::unsealHeap();
  std::printf("localized %d of 4 frames, pairer %s, aligner %s, without the heap\n", localized,
              paired ? "works" : "fails", aligned ? "works" : "fails");
  const bool intact = everything.state.guardsIntact() && everything.scratch.guardsIntact() &&
                      everything.features_memory.guardsIntact() && everything.aligner_memory.guardsIntact();
  return localized == 4 && paired && aligned && intact ? 0 : 1;
}
