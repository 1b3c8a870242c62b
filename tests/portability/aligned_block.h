/* Memory at an aligned address.  Not every C library has aligned_alloc. */
#ifndef ALIGNED_BLOCK_H
#define ALIGNED_BLOCK_H

#include <stdint.h>
#include <stdlib.h>

/* The aligned address in *block, which is to be freed; null, and so is *block, where there is no memory. */
static inline void *aligned_block(size_t bytes, size_t alignment, void **block) {
  *block = malloc(bytes + alignment);
  return *block ? (uint8_t *)*block + (alignment - (uintptr_t)*block % alignment) % alignment : NULL;
}

#endif
