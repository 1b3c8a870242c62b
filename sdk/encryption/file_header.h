/* file_header.h - in what an encrypted map begins: docs/encryption.md. */
#ifndef SPHC_ENCRYPTION_FILE_HEADER_H
#define SPHC_ENCRYPTION_FILE_HEADER_H

#include <stddef.h>
#include <stdint.h>

#include "encryption/aead.h"
#include "spherecloud/spherecloud_encryption.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SPHC_ENCRYPTION_KEY_ID_BYTES = 16 };

typedef struct sphc_encryption_header {
  uint64_t map_bytes;
  uint8_t key_id[SPHC_ENCRYPTION_KEY_ID_BYTES];
  uint8_t nonce[SPHC_AEAD_NONCE_BYTES];
} sphc_encryption_header;

/* By it a file says which key it is of; it tells nothing of the key: HChaCha20 of it and a constant. [pure] */
void sphc_encryption_key_id(const sphc_encryption_key *key, uint8_t key_id[SPHC_ENCRYPTION_KEY_ID_BYTES]);

/* [pure] */
void sphc_encryption_header_write(const sphc_encryption_header *header,
                                  uint8_t bytes[SPHC_ENCRYPTION_HEADER_BYTES]);
/* 1: it is a header of this version; 0: `header` is untouched. [pure] */
int sphc_encryption_header_read(const uint8_t bytes[SPHC_ENCRYPTION_HEADER_BYTES], sphc_encryption_header *header);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_ENCRYPTION_FILE_HEADER_H */
