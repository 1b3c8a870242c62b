/* aead.h - XChaCha20-Poly1305 (RFC 8439, section 2.8; draft-irtf-cfrg-xchacha-03), the half that decrypts. */
#ifndef SPHC_ENCRYPTION_AEAD_H
#define SPHC_ENCRYPTION_AEAD_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { SPHC_AEAD_NONCE_BYTES = 24, SPHC_AEAD_TAG_BYTES = 16 };

typedef struct sphc_aead_text {
  const uint8_t *header; /* is not encrypted, and authenticated */
  size_t header_bytes;
  const uint8_t *cipher;
  size_t bytes;       /* of cipher and plain text */
  const uint8_t *tag; /* of SPHC_AEAD_TAG_BYTES bytes */
} sphc_aead_text;

/* 1: the tag fits, and `plain`, which may be text->cipher, has the plain text.  0: nothing was written. [pure] */
int sphc_aead_open(const uint8_t key[32], const uint8_t nonce[SPHC_AEAD_NONCE_BYTES], const sphc_aead_text *text,
                   uint8_t *plain);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_ENCRYPTION_AEAD_H */
