#include "line.h"

static void put(line *l, char c) {
  if (l->length + 1 < sizeof l->text) l->text[l->length++] = c;
  l->text[l->length] = '\0';
}

void line_text(line *l, const char *text) {
  while (*text) put(l, *text++);
}

static void line_name(line *l, const char *name) {
  if (l->length) put(l, ' ');
  line_text(l, name);
  put(l, ' ');
}

void line_number(line *l, const char *name, int64_t value) {
  char digits[20];
  int count = 0;
  uint64_t rest = value < 0 ? ~(uint64_t)value + 1 : (uint64_t)value;
  line_name(l, name);
  if (value < 0) put(l, '-');
  do digits[count++] = (char)('0' + rest % 10);
  while (rest /= 10);
  while (count) put(l, digits[--count]);
}

void line_digest(line *l, const char *name, uint64_t digest) {
  line_name(l, name);
  for (int shift = 60; shift >= 0; shift -= 4) put(l, "0123456789abcdef"[(digest >> shift) & 15]);
}

uint64_t digest_bytes(uint64_t digest, const void *data, size_t bytes) {
  const uint8_t *p = (const uint8_t *)data;
  while (bytes--) digest = (digest ^ *p++) * 0x100000001B3u;
  return digest;
}

uint64_t digest_doubles(uint64_t digest, const double *values, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    union {
      double value;
      uint64_t bits;
    } number = {values[i]};
    for (int shift = 0; shift < 64; shift += 8) {
      const uint8_t byte = (uint8_t)(number.bits >> shift);
      digest = digest_bytes(digest, &byte, 1);
    }
  }
  return digest;
}
