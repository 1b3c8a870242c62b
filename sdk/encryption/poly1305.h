/* poly1305.h - the authenticator Poly1305 (RFC 8439, section 2.5) of whole blocks, as the AEAD needs it. */
#ifndef SPHC_ENCRYPTION_POLY1305_H
#define SPHC_ENCRYPTION_POLY1305_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Numbers modulo 2^130 - 5, as five limbs of 26 bits.  All that is derived from the key is in here: wipe it. */
typedef struct sphc_poly1305 {
  uint32_t r[5], sum[5];
  uint8_t pad[16];
  uint32_t limbs[5]; /* of a calculation, as what follows */
  uint64_t wide[5];
} sphc_poly1305;

/* A key serves for one message. [pure] */
void sphc_poly1305_init(sphc_poly1305 *state, const uint8_t key[32]);
/* Adds bytes, and zeroes up to the end of a block of 16. [pure] */
void sphc_poly1305_add_padded(sphc_poly1305 *state, const uint8_t *data, size_t bytes);
/* Ends the message. [pure] */
void sphc_poly1305_tag(sphc_poly1305 *state, uint8_t tag[16]);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_ENCRYPTION_POLY1305_H */
