// Prints how deep the stack of each call goes: call,bytes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "lab/common/painted_stack.h"
#include "tests/support/session.h"

namespace {

using sphc::host::deepestOf;

// Runs each task on a thread of its own, and knows how deep the deepest went.
void runTasks(void *deepest, uint32_t count, sphc_task_fn task, void *task_data) {
  auto &most = *static_cast<size_t *>(deepest);
  for (uint32_t i = 0; i < count; ++i) most = std::max(most, deepestOf([&] { task(task_data, i); }));
}

size_t deepestTask() {
  size_t deepest = 0;
  sphc_localizer_config config = sphc::test::sceneConfig();
  config.parallel = runTasks;
  config.parallel_user = &deepest;
  config.parallel_tasks = 2;
  sphc::test::Session session(config);
  sphc_localizer_result result = {};
  if (session.process(sphc::test::sceneFrame(config, 1)->frame, &result) != SPHC_OK) std::abort();
  return deepest;
}

}  // namespace

int main() {
  const sphc_localizer_config config = sphc::test::sceneConfig();
  sphc::test::Session session(config);
  const auto frame = sphc::test::sceneFrame(config, 1);
  sphc_localizer_result result = {};
  // Once on this thread, so that lazily bound symbols and the choice of SIMD instructions are behind us.
  if (session.process(frame->frame, &result) != SPHC_OK) return 1;
  const size_t thread_itself = deepestOf([] {});
  const auto print = [&](const char *name, const std::function<void()> &call) {
    std::printf("%s,%zu\n", name, deepestOf(call) - thread_itself);
  };
  std::printf("call,bytes\n");
  sphc_memory need = {};
  print("sphc_localizer_process", [&] { session.process(frame->frame, &result); });
  sphc_features_memory(&config, &need, nullptr);
  sphc::test::GuardedMemory features_memory(need.state_bytes, need.alignment);
  sphc_features *features = nullptr;
  sphc_features_init(features_memory.data(), features_memory.size(), &config, &features, nullptr);
  print("sphc_localizer_extract", [&] { sphc_localizer_extract(session.localizer(), &frame->frame, features); });
  print("sphc_localizer_locate",
        [&] { sphc_localizer_locate(session.localizer(), &frame->frame, features, &result); });
  std::printf("a task of config.parallel,%zu\n", deepestTask() - thread_itself);
  print("sphc_localizer_memory", [&] { sphc_localizer_memory(&config, &need, nullptr); });
  sphc_localizer *second = nullptr;
  print("sphc_localizer_init", [&] {
    sphc_localizer_init(session.state().data(), session.state().size(), session.scratch().data(),
                        session.scratch().size(), &config, &second, nullptr);
  });
  sphc_aligner_config aligning;
  sphc_aligner_config_init(&aligning, sizeof aligning);
  aligning.rig = config.rig;
  sphc_aligner_memory(&aligning, &need, nullptr);
  sphc::test::GuardedMemory aligner_memory(need.state_bytes, need.alignment);
  sphc_aligner *aligner = nullptr;
  print("sphc_aligner_init",
        [&] { sphc_aligner_init(aligner_memory.data(), aligner_memory.size(), &aligning, &aligner, nullptr); });
  const sphc_aligned nowhere = {sizeof nowhere, 0, 0, 0, nullptr, nullptr, nullptr};
  print("sphc_aligner_process", [&] { sphc_aligner_process(aligner, &frame->frame.depth, &nowhere); });
  sphc_map_memory(&need);
  sphc::test::GuardedMemory memory(need.state_bytes, need.alignment);
  sphc_map *map = nullptr;
  const auto &file = session.sceneMap().file;
  print("sphc_map_init",
        [&] { sphc_map_init(memory.data(), memory.size(), file.data(), file.size(), &map, nullptr); });
  return 0;
}
