/* strict_ed25519.h - Ed25519 (RFC 8032) with one answer for all: what the RFC leaves to verifiers is refused. */
#ifndef SPHC_SIGNATURE_STRICT_ED25519_H
#define SPHC_SIGNATURE_STRICT_ED25519_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPHC_ED25519_MESSAGE_MAX 144 /* bytes of a message; its copy is on the stack */

/* Whether a public key may be trusted: its y is below p, and it is none of the points of small order, whose
 * signatures anybody makes.  1 or 0. [pure] */
int sphc_ed25519_is_good_key(const uint8_t key[32]);

/* Whether `signature` (R, then S) is one of the message by the key.  As RFC 8032 without the cofactor: S is below
 * the group's order, and R and the key are as sphc_ed25519_is_good_key asks.  1 or 0. [pure] */
int sphc_ed25519_verify(const uint8_t key[32], const void *message, size_t message_bytes,
                        const uint8_t signature[64]);

#ifdef __cplusplus
}
#endif
#endif /* SPHC_SIGNATURE_STRICT_ED25519_H */
