/* wipe.h - forgets a secret. */
#ifndef SPHC_ENCRYPTION_WIPE_H
#define SPHC_ENCRYPTION_WIPE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes zeroes that no compiler leaves away. [pure] */
void sphc_wipe(void *secret, size_t bytes);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_ENCRYPTION_WIPE_H */
