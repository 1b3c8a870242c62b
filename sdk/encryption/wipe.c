#include "encryption/wipe.h"

#include <stdint.h>

void sphc_wipe(void *secret, size_t bytes) {
  volatile uint8_t *byte = (volatile uint8_t *)secret;
  while (bytes--) *byte++ = 0;
}
