#include "host/mapping/solver_memory.h"

#include <SuiteSparse_config.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "tests/support/is_sanitized.h"

namespace sphc::host {
namespace {

constexpr size_t kTooMany = SIZE_MAX / 4;
int handled = 0;

void countAndThrow() {
  ++handled;
  throw std::bad_alloc();
}

TEST(SolverMemory, TheNewHandlerHearsOfWhatCholmodDidNotGet) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer's heap ends the program";
  callNewHandlerForCholmod();
  const std::new_handler before = std::set_new_handler(countAndThrow);
  int ok = 1;
  void *memory = SuiteSparse_malloc(16, 1);
  EXPECT_EQ(handled, 0);
  EXPECT_EQ(SuiteSparse_realloc(kTooMany, 16, 1, memory, &ok), memory);  // the old one stays
  EXPECT_EQ(ok, 0);
  EXPECT_EQ(handled, 1);
  SuiteSparse_free(memory);
  EXPECT_EQ(SuiteSparse_malloc(kTooMany, 1), nullptr);
  EXPECT_EQ(SuiteSparse_calloc(kTooMany, 1), nullptr);
  EXPECT_EQ(handled, 3);
  std::set_new_handler(nullptr);
  EXPECT_EQ(SuiteSparse_malloc(kTooMany, 1), nullptr);
  EXPECT_EQ(handled, 3);
  std::set_new_handler(before);
}

}  // namespace
}  // namespace sphc::host
