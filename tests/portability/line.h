/* A line of text and a digest, without a C library. */
#ifndef PORTABILITY_LINE_H
#define PORTABILITY_LINE_H

#include <stddef.h>
#include <stdint.h>

#include "replay.h"

typedef struct line {
  char text[REPLAY_LINE_BYTES];
  size_t length;
} line;

void line_text(line *l, const char *text);
void line_number(line *l, const char *name, int64_t value); /* " name value" */
void line_digest(line *l, const char *name, uint64_t digest);

/* FNV-1a, 64 bits. */
#define DIGEST_START 0xCBF29CE484222325u
uint64_t digest_bytes(uint64_t digest, const void *data, size_t bytes);
uint64_t digest_doubles(uint64_t digest, const double *values, size_t count); /* low bytes first */

#endif
