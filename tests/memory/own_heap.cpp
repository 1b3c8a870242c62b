#include "tests/memory/own_heap.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>

// The linker's names for where the program's code begins and ends.
extern "C" {
extern const char __executable_start, etext;
void *__real_malloc(size_t bytes);
void *__real_calloc(size_t count, size_t bytes);
void *__real_realloc(void *memory, size_t bytes);
void __real_free(void *memory);
}

namespace {

constexpr int kMaxBlocks = 1024;

// The blocks of our own that are not freed; a library's way of freeing may look like ours, so each is known by
// address.
std::mutex mutex;
void *own_blocks[kMaxBlocks];
std::atomic<int64_t> calls{0}, blocks{0};

bool isOurs(const void *caller) {
  const char *address = static_cast<const char *>(caller);
  return address >= &__executable_start && address < &etext;
}

void *noteNew(void *memory) {
  if (!memory) return nullptr;
  const std::lock_guard<std::mutex> lock(mutex);
  for (void *&block : own_blocks) {
    if (block) continue;
    block = memory;
    ++calls, ++blocks;
    return memory;
  }
  std::abort();  // too few places
}

void noteDelete(const void *memory) {
  if (!memory) return;
  const std::lock_guard<std::mutex> lock(mutex);
  for (void *&block : own_blocks) {
    if (block != memory) continue;
    block = nullptr;
    ++calls, --blocks;
    return;
  }
}

void *allocate(size_t bytes, const void *caller) {
  void *memory = __real_malloc(bytes ? bytes : 1);
  return isOurs(caller) ? noteNew(memory) : memory;
}

void release(void *memory) {
  noteDelete(memory);
  __real_free(memory);
}

}  // namespace

namespace sphc::test {
OwnHeap ownHeap() { return {calls, blocks}; }
}  // namespace sphc::test

// malloc and its kin: --wrap sees the calls of this program alone.
extern "C" {
void *__wrap_malloc(size_t bytes) { return noteNew(__real_malloc(bytes)); }
void *__wrap_calloc(size_t count, size_t bytes) { return noteNew(__real_calloc(count, bytes)); }
void *__wrap_realloc(void *memory, size_t bytes) {
  noteDelete(memory);
  return noteNew(__real_realloc(memory, bytes));
}
void __wrap_free(void *memory) { release(memory); }
}

// Operators are shared with the libraries: the return address tells who called.
#define CALLER __builtin_return_address(0)

void *operator new(size_t bytes) {
  void *memory = allocate(bytes, CALLER);
  if (!memory) std::abort();
  return memory;
}
void *operator new[](size_t bytes) {
  void *memory = allocate(bytes, CALLER);
  if (!memory) std::abort();
  return memory;
}
void *operator new(size_t bytes, const std::nothrow_t &) noexcept { return allocate(bytes, CALLER); }
void *operator new[](size_t bytes, const std::nothrow_t &) noexcept { return allocate(bytes, CALLER); }
void operator delete(void *memory) noexcept { release(memory); }
void operator delete[](void *memory) noexcept { release(memory); }
void operator delete(void *memory, size_t) noexcept { release(memory); }
void operator delete[](void *memory, size_t) noexcept { release(memory); }
