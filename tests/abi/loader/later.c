#include "later.h"

uint32_t sphc_later(void) { return 7; }
