/* sha512.h - SHA-512 (FIPS 180-4, RFC 6234), in memory of its caller. */
#ifndef SPHC_SIGNATURE_SHA512_H
#define SPHC_SIGNATURE_SHA512_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPHC_SHA512_BYTES 64

/* Hashes `bytes` bytes, up to 2^61 of them. [pure] */
void sphc_sha512(const void *data, size_t bytes, uint8_t hash[SPHC_SHA512_BYTES]);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_SIGNATURE_SHA512_H */
