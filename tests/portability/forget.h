/* forget.h - memory that the caller has not set: MemorySanitizer, where it is compiled in, or Valgrind, where a
 * program runs under it, says if something depends on what it holds. */
#ifndef SPHC_TESTS_PORTABILITY_FORGET_H
#define SPHC_TESTS_PORTABILITY_FORGET_H

#ifdef __has_feature
#if __has_feature(memory_sanitizer)
#include <sanitizer/msan_interface.h>
#define FORGET(memory) __msan_allocated_memory(memory, sizeof memory)
#endif
#endif
#if !defined FORGET && defined SPHC_HAVE_VALGRIND
#include <valgrind/memcheck.h>
#define FORGET(memory) (void)VALGRIND_MAKE_MEM_UNDEFINED(memory, sizeof memory)
#endif
#ifndef FORGET
#define FORGET(memory) (void)(memory)
#endif

#endif /* SPHC_TESTS_PORTABILITY_FORGET_H */
