/* statement.h - what a signature says of a map, and the bytes in which it says so: docs/signatures.md. */
#ifndef SPHC_SIGNATURE_STATEMENT_H
#define SPHC_SIGNATURE_STATEMENT_H

#include <stddef.h>
#include <stdint.h>

#include "signature/sha512.h"
#include "spherecloud/spherecloud_signature.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SPHC_STATEMENT_BYTES = 144, SPHC_KEY_ID_BYTES = 16 };

typedef struct sphc_statement {
  uint64_t release, map_bytes;
  uint8_t key_id[SPHC_KEY_ID_BYTES];
  char name[SPHC_SIGNATURE_NAME_BYTES]; /* zeroes from its end on */
  uint8_t map_sha512[SPHC_SHA512_BYTES];
} sphc_statement;

/* The first bytes of the key's SHA-512. [pure] */
void sphc_statement_key_id(const uint8_t key[32], uint8_t key_id[SPHC_KEY_ID_BYTES]);

/* [pure] */
void sphc_statement_write(const sphc_statement *statement, uint8_t bytes[SPHC_STATEMENT_BYTES]);
/* 1: it is a statement of this version; 0: `statement` is untouched. [pure] */
int sphc_statement_read(const uint8_t bytes[SPHC_STATEMENT_BYTES], sphc_statement *statement);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_SIGNATURE_STATEMENT_H */
