#include "host/mapping/solver_memory.h"

#include <SuiteSparse_config.h>

#include <cstdlib>
#include <new>

namespace sphc::host {
namespace {

// CHOLMOD is C: no exception may go through it.
void *told(void *memory) noexcept {
  const std::new_handler handler = std::get_new_handler();
  if (memory || !handler) return memory;
  try {
    handler();
  } catch (const std::bad_alloc &) {
  }
  return nullptr;
}

void *mallocOrTell(size_t bytes) { return told(std::malloc(bytes)); }
void *callocOrTell(size_t count, size_t bytes) { return told(std::calloc(count, bytes)); }
void *reallocOrTell(void *old, size_t bytes) { return told(std::realloc(old, bytes)); }

}  // namespace

void callNewHandlerForCholmod() {
#if SUITESPARSE_MAIN_VERSION >= 7
  SuiteSparse_config_malloc_func_set(mallocOrTell);
  SuiteSparse_config_calloc_func_set(callocOrTell);
  SuiteSparse_config_realloc_func_set(reallocOrTell);
#else
  SuiteSparse_config.malloc_func = mallocOrTell;
  SuiteSparse_config.calloc_func = callocOrTell;
  SuiteSparse_config.realloc_func = reallocOrTell;
#endif
}

}  // namespace sphc::host
