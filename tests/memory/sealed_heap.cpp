#include "tests/memory/sealed_heap.h"

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

bool sealed = false;

void touch(const char *what) {
  if (!sealed) return;
  sealed = false;
  const char *parts[] = {"sealed heap: ", what, " was called between init and fini\n"};
  for (const char *part : parts)
    if (write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
  _exit(1);
}

}  // namespace

namespace sphc::test {
void sealHeap() { sealed = true; }
void unsealHeap() { sealed = false; }
}  // namespace sphc::test

// The names are the linker's.
extern "C" {
void *__real_malloc(size_t bytes);
void *__real_calloc(size_t count, size_t bytes);
void *__real_realloc(void *memory, size_t bytes);
void __real_free(void *memory);
int __real_posix_memalign(void **memory, size_t alignment, size_t bytes);
void *__real_aligned_alloc(size_t alignment, size_t bytes);
void *__real_memalign(size_t alignment, size_t bytes);
char *__real_strdup(const char *text);

void *__wrap_malloc(size_t bytes) { return touch("malloc"), __real_malloc(bytes); }
void *__wrap_calloc(size_t count, size_t bytes) { return touch("calloc"), __real_calloc(count, bytes); }
void *__wrap_realloc(void *memory, size_t bytes) { return touch("realloc"), __real_realloc(memory, bytes); }
void __wrap_free(void *memory) { touch("free"), __real_free(memory); }
int __wrap_posix_memalign(void **memory, size_t alignment, size_t bytes) {
  return touch("posix_memalign"), __real_posix_memalign(memory, alignment, bytes);
}
void *__wrap_aligned_alloc(size_t alignment, size_t bytes) {
  return touch("aligned_alloc"), __real_aligned_alloc(alignment, bytes);
}
void *__wrap_memalign(size_t alignment, size_t bytes) {
  return touch("memalign"), __real_memalign(alignment, bytes);
}
char *__wrap_strdup(const char *text) { return touch("strdup"), __real_strdup(text); }
}

namespace {

void *allocate(size_t bytes) {
  touch("new");
  void *memory = __real_malloc(bytes ? bytes : 1);
  if (!memory) std::abort();
  return memory;
}
void *allocateAligned(size_t bytes, std::align_val_t alignment) {
  touch("new");
  void *memory = nullptr;
  if (__real_posix_memalign(&memory, static_cast<size_t>(alignment), bytes ? bytes : 1) != 0) std::abort();
  return memory;
}
void release(void *memory) {
  touch("delete");
  __real_free(memory);
}

}  // namespace

void *operator new(size_t bytes) { return allocate(bytes); }
void *operator new[](size_t bytes) { return allocate(bytes); }
void *operator new(size_t bytes, std::align_val_t alignment) { return allocateAligned(bytes, alignment); }
void *operator new[](size_t bytes, std::align_val_t alignment) { return allocateAligned(bytes, alignment); }
void operator delete(void *memory) noexcept { release(memory); }
void operator delete[](void *memory) noexcept { release(memory); }
void operator delete(void *memory, size_t) noexcept { release(memory); }
void operator delete[](void *memory, size_t) noexcept { release(memory); }
void operator delete(void *memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void *memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void *memory, size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void *memory, size_t, std::align_val_t) noexcept { release(memory); }
