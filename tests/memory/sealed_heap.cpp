// Takes the place of the C library's heap in this program (glibc lets a program do so).
#include "tests/memory/sealed_heap.h"

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>

extern "C" {
void *__libc_malloc(size_t bytes);
void *__libc_calloc(size_t count, size_t bytes);
void *__libc_realloc(void *memory, size_t bytes);
void *__libc_memalign(size_t alignment, size_t bytes);
void __libc_free(void *memory);
}

namespace {

thread_local bool sealed = false;
size_t calls = 0;

void passSeal() {
  __atomic_fetch_add(&calls, 1, __ATOMIC_RELAXED);
  if (!sealed) return;
  constexpr char kText[] = "the heap was called while it was sealed\n";
  if (write(2, kText, sizeof kText - 1) < 0) _exit(2);
  std::abort();
}

}  // namespace

extern "C" {

void *malloc(size_t bytes) {
  passSeal();
  return __libc_malloc(bytes);
}
void *calloc(size_t count, size_t bytes) {
  passSeal();
  return __libc_calloc(count, bytes);
}
void *realloc(void *memory, size_t bytes) {
  passSeal();
  return __libc_realloc(memory, bytes);
}
void free(void *memory) {
  if (!memory) return;
  passSeal();
  __libc_free(memory);
}
void *memalign(size_t alignment, size_t bytes) {
  passSeal();
  return __libc_memalign(alignment, bytes);
}
void *aligned_alloc(size_t alignment, size_t bytes) {
  passSeal();
  return __libc_memalign(alignment, bytes);
}
int posix_memalign(void **memory, size_t alignment, size_t bytes) {
  passSeal();
  *memory = __libc_memalign(alignment, bytes);
  return *memory ? 0 : ENOMEM;
}

}  // extern "C"

namespace sphc::test {

SealedHeap::SealedHeap() { sealed = true; }
SealedHeap::~SealedHeap() { sealed = false; }
size_t heapCalls() { return __atomic_load_n(&calls, __ATOMIC_RELAXED); }

}  // namespace sphc::test
