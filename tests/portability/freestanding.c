/* The runtime without an operating system's libraries: a program that brings the four functions the runtime asks
 * for and nothing else.  x86-64 Linux, for there it can be run. */
#include "data.h"
#include "replay.h"

void *memcpy(void *target, const void *source, size_t bytes) {
  char *t = (char *)target;
  const char *s = (const char *)source;
  while (bytes--) *t++ = *s++;
  return target;
}

void *memmove(void *target, const void *source, size_t bytes) {
  char *t = (char *)target;
  const char *s = (const char *)source;
  if (t < s) return memcpy(target, source, bytes);
  while (bytes--) t[bytes] = s[bytes];
  return target;
}

void *memset(void *target, int value, size_t bytes) {
  char *t = (char *)target;
  while (bytes--) *t++ = (char)value;
  return target;
}

size_t strlen(const char *text) {
  size_t length = 0;
  while (text[length]) ++length;
  return length;
}

static long system_call(long number, long a, const void *b, size_t c) {
  long result;
  __asm__ volatile("syscall" : "=a"(result) : "a"(number), "D"(a), "S"(b), "d"(c) : "rcx", "r11", "memory");
  return result;
}

static void print(void *user, const char *text) {
  (void)user;
  system_call(1, 1, text, strlen(text));
  system_call(1, 1, "\n", 1);
}

__attribute__((force_align_arg_pointer, noreturn)) void _start(void);
void _start(void) {
  const int failed = replay_check(data_map, (size_t)(data_map_end - data_map), data_expected, print, NULL);
  system_call(231, failed, NULL, 0);
  for (;;) {
  }
}
