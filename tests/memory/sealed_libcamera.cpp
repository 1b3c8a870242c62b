// The libcamera driver while the heap is sealed: between start and stop none of our code may allocate, on good days
// and bad.  (libcamera itself does, in its own libraries, and so does the fake that stands for it here.)
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

#include "drivers/libcamera/libcamera.h"
#include "tests/contract/fake_libcamera.h"
#include "tests/memory/sealed_heap.h"

namespace {

using sphc::contract::FakeLibcamera;

void require(bool fine, const char *what) {
  if (fine) return;
  sphc::test::unsealHeap();
  std::fprintf(stderr, "sealed_libcamera: %s\n", what);
  std::exit(1);
}

sphc_status acquire(const sphc_source &source) {
  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  const sphc_status status = source.acquire(source.self, 1000, &capture);
  if (status == SPHC_OK) source.release(source.self, &capture);
  return status;
}

void captureSome(FakeLibcamera &fake, const sphc_source &source) {
  require(source.start(source.self) == SPHC_OK, "start");
  for (int i = 0; i < 60; ++i) {
    fake.next_damaged = i % 7 == 6;
    fake.missing_bytes = i % 11 == 10 ? 50 : 0;
    fake.gives_time = i % 5 != 0;
    const sphc_status status = acquire(source);
    require(status == SPHC_OK || status == SPHC_E_DEVICE, "captures");
  }
  source.stop(source.self);
}

}  // namespace

int main() {
  void *library = dlopen(SPHC_FAKE_LIBCAMERA, RTLD_NOW | RTLD_NODELETE);
  require(library != nullptr, "no fake");
  const auto symbol = dlsym(library, sphc::contract::kFakeLibcameraSymbol);
  FakeLibcamera &fake = *reinterpret_cast<sphc::contract::FakeLibcameraFn>(symbol)();
  sphc_libcamera_config config;
  sphc_libcamera_config_init(&config, sizeof config);
  config.plugin_path = SPHC_FAKE_LIBCAMERA;
  sphc_libcamera *camera = nullptr;
  sphc_message message = {};
  require(sphc_libcamera_open(nullptr, &config, &camera, &message) == SPHC_OK, message.text);
  sphc_source source;
  sphc_libcamera_source(camera, &source);

  sphc::test::sealHeap();
  captureSome(fake, source);
  captureSome(fake, source);
  require(source.start(source.self) == SPHC_OK, "start before the cable is pulled");
  fake.unplugged = true;
  require(acquire(source) == SPHC_E_DEVICE_LOST, "unplugged");
  source.stop(source.self);
  sphc::test::unsealHeap();
  sphc_libcamera_close(&camera);
  std::puts("nothing was allocated");
  return 0;
}
