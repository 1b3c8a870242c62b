/* chacha20.h - the stream cipher ChaCha20 (RFC 8439, section 2) and HChaCha20 (draft-irtf-cfrg-xchacha-03, section
 * 2.2).  No tables and no branches on secrets. */
#ifndef SPHC_ENCRYPTION_CHACHA20_H
#define SPHC_ENCRYPTION_CHACHA20_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Adds the key stream from block `counter` on to `bytes` bytes, up to 2^38 less 64 of them; `in` and `out` may be
 * equal. [pure] */
void sphc_chacha20_xor(const uint8_t key[32], const uint8_t nonce[12], uint32_t counter, const uint8_t *in,
                       uint8_t *out, size_t bytes);

/* Another key, of a key and 16 bytes. [pure] */
void sphc_hchacha20(const uint8_t key[32], const uint8_t input[16], uint8_t derived[32]);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_ENCRYPTION_CHACHA20_H */
