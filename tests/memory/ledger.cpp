// Prints the byte ledger: every array of the layout walk, and the deepest stack of a call, for some configurations.
#include <pthread.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/support/session.h"

namespace {

constexpr size_t kStackBytes = 1 << 20;
constexpr unsigned char kPaint = 0xA5;

sphc_config configOf(uint32_t width, uint32_t height, uint32_t keypoints) {
  sphc_config config = sphc::test::sceneConfig();
  config.color_camera = sphc::test::pinhole(width, height, 0.8 * width);
  config.max_keypoints = keypoints;
  return config;
}

void printPieces(const std::string &name, const sphc_config &config) {
  sphc_memory need;
  if (sphc_localizer_memory(&config, &need, nullptr) != SPHC_OK) std::abort();
  std::printf("%s,state,total,%zu\n%s,scratch,total,%zu\n", name.c_str(), need.state_bytes, name.c_str(),
              need.scratch_bytes);
  // Pieces of one name are one line.
  sphc_memory_piece piece, next;
  uint32_t index = 0;
  if (sphc_localizer_memory_piece(&config, index, &piece) != SPHC_OK) std::abort();
  for (bool more = true; more; piece = next) {
    more = sphc_localizer_memory_piece(&config, ++index, &next) == SPHC_OK;
    if (more && !std::strcmp(piece.name, next.name) && piece.scratch == next.scratch) {
      next.bytes += piece.bytes;
      continue;
    }
    std::printf("%s,%s,%s,%zu\n", name.c_str(), piece.scratch ? "scratch" : "state", piece.name, piece.bytes);
  }
}

struct Call {
  sphc_localizer *localizer;
  const sphc_frame *frame;
  sphc_status status;
};

void *process(void *user) {
  Call *call = static_cast<Call *>(user);
  sphc_result result = {};
  result.struct_size = sizeof result;
  call->status = sphc_localizer_process(call->localizer, call->frame, &result);
  return nullptr;
}

// Bytes of a painted stack that a thread touched.
size_t stackOf(void *(*run)(void *), void *user) {
  auto *stack = static_cast<unsigned char *>(std::aligned_alloc(4096, kStackBytes));
  std::memset(stack, kPaint, kStackBytes);
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack, kStackBytes);
  if (pthread_create(&thread, &attributes, run, user) != 0) std::abort();
  pthread_join(thread, nullptr);
  size_t untouched = 0;
  while (untouched < kStackBytes && stack[untouched] == kPaint) ++untouched;
  std::free(stack);
  return kStackBytes - untouched;
}

}  // namespace

int main() {
  std::printf("configuration,memory,piece,bytes\n");
  printPieces("640x480 400 keypoints", configOf(640, 480, 400));
  printPieces("640x480 800 keypoints", configOf(640, 480, 800));
  printPieces("640x480 1600 keypoints", configOf(640, 480, 1600));
  printPieces("1280x720 800 keypoints", configOf(1280, 720, 800));

  const sphc_config config = sphc::test::sceneConfig();
  sphc::test::Session session(config);
  const auto frame = sphc::test::sceneFrame(config, 1);
  Call call = {session.localizer(), &frame->frame, SPHC_E_INTERNAL};
  const size_t idle = stackOf([](void *) -> void * { return nullptr; }, nullptr);
  const size_t used = stackOf(process, &call) - idle;
  if (call.status != SPHC_OK) std::abort();
  // Compilers differ by some kilobytes: the ledger keeps the next 8 KiB.
  std::printf("any,stack,sphc_localizer_process at most,%zu\n", (used + 8191) / 8192 * 8192);
}
