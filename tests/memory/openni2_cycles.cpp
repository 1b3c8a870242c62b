// openni2_cycles CYCLES [--leak | --allocate] - plugs a virtual camera in, opens it, and pulls the plug in another
// state each time.  Threads, files and our own heap must be as before, and between start and stop our code may not
// call the heap at all.  --leak and --allocate do wrong, to show that it is noticed.
#include <malloc.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "drivers/openni2/openni2.h"
#include "tests/memory/own_heap.h"
#include "tests/support/openni2/virtual_tof.h"

namespace {

namespace vtof = sphc::vtof;
using sphc::test::ownHeap;

constexpr uint32_t kPatienceUs = 10000000;
const char *wrong = "";
void *volatile keep = nullptr;  // hides wrong calls from the optimiser

void require(bool fine, const char *what, int cycle) {
  if (fine) return;
  std::fprintf(stderr, "cycle %d: %s\n", cycle, what);
  std::_Exit(1);  // threads of the open camera still use what exit would destroy
}

struct Belongings {
  ptrdiff_t threads, files;
  int64_t blocks;
  size_t library_bytes;
};

ptrdiff_t countEntries(const char *folder) {
  const std::filesystem::directory_iterator entries(folder);
  return std::distance(begin(entries), end(entries));
}

Belongings belongings() {
  const int64_t blocks = ownHeap().blocks;
  return {countEntries("/proc/self/task"), countEntries("/proc/self/fd"), blocks, mallinfo2().uordblks};
}

sphc_openni2 *openCamera(int cycle) {
  sphc_openni2 *camera = nullptr;
  require(sphc_openni2_open(vtof::uri(0), nullptr, &camera, nullptr) == SPHC_OK, "does not open", cycle);
  return camera;
}

// Some frames, one of them still on loan when the plug is pulled.
void capture(const sphc_source &source, int cycle) {
  const int64_t calls = ownHeap().calls;
  for (int index = 1; index <= 3; ++index) {
    vtof::emitPair(0, 2 * index);
    for (int i = 0; i < 2; ++i) {
      sphc_capture capture = {};
      capture.struct_size = sizeof capture;
      require(source.acquire(source.self, kPatienceUs, &capture) == SPHC_OK, "a frame stays away", cycle);
      if (index != 3) source.release(source.self, &capture);
    }
  }
  vtof::unplug(0);
  sphc_capture none = {};
  none.struct_size = sizeof none;
  require(source.acquire(source.self, kPatienceUs, &none) == SPHC_E_DEVICE_LOST, "the loss goes unnoticed", cycle);
  if (!std::strcmp(wrong, "--allocate")) keep = ::operator new(8);
  require(ownHeap().calls == calls, "our code called the heap between start and stop", cycle);
}

void expectGaps(const sphc_openni2 *camera, int cycle) {
  sphc_openni2_statistics statistics = {};
  statistics.struct_size = sizeof statistics;
  sphc_openni2_get_statistics(camera, &statistics);
  require(statistics.color.lost == 2 && statistics.depth.lost == 2, "gaps are not counted", cycle);
}

void run(int cycle) {
  vtof::plug(0);
  sphc_openni2 *camera = openCamera(cycle);
  sphc_source source = {};
  sphc_openni2_source(camera, &source);
  const bool before_start = cycle % 3 == 0, after_stop = cycle % 3 == 1;
  if (before_start) {
    vtof::unplug(0);
    require(source.start(source.self) == SPHC_E_DEVICE_LOST, "starts without a device", cycle);
  } else {
    require(source.start(source.self) == SPHC_OK, source.message(source.self), cycle);
    if (after_stop) {
      source.stop(source.self);
      vtof::unplug(0);
    } else {
      capture(source, cycle);
      expectGaps(camera, cycle);
    }
  }
  sphc_openni2_close(&camera);
  if (!std::strcmp(wrong, "--leak")) keep = ::operator new(8);
}

}  // namespace

int main(int argc, char **argv) {
  const int cycles = argc > 1 ? std::atoi(argv[1]) : 0;
  if (argc > 2) wrong = argv[2];
  constexpr int kWarmUp = 6;
  if (cycles <= kWarmUp) return 2;
  for (int cycle = 0; cycle < kWarmUp; ++cycle) run(cycle);
  const Belongings before = belongings();
  for (int cycle = kWarmUp; cycle < cycles; ++cycle) run(cycle);
  const Belongings after = belongings();
  std::printf(
      "%d cycles: threads %td -> %td, files %td -> %td, our blocks %lld -> %lld, OpenNI2's %.0f bytes a cycle\n",
      cycles, before.threads, after.threads, before.files, after.files, static_cast<long long>(before.blocks),
      static_cast<long long>(after.blocks),
      (static_cast<double>(after.library_bytes) - static_cast<double>(before.library_bytes)) / (cycles - kWarmUp));
  return before.threads == after.threads && before.files == after.files && before.blocks == after.blocks ? 0 : 1;
}
