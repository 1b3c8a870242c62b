/* ed25519.h - what ed25519.c offers and asks for; of this project. */
#ifndef THIRD_PARTY_OPENSSH_ED25519_H
#define THIRD_PARTY_OPENSSH_ED25519_H

#define crypto_sign_ed25519_open sphc_vendored_ed25519_open
#define crypto_hash_sha512 sphc_vendored_hash_sha512

/* Asked for: SHA-512 of some bytes. */
int crypto_hash_sha512(unsigned char out[64], const unsigned char *in, unsigned long long in_bytes);

/* 0 where `sm` is a signature of 64 bytes and the message behind it, signed with the secret of `pk`; -1 otherwise.
 * `m` is as long as `sm` and gets the message.  Takes any S below 2^253, and keys and R that a strict verifier
 * refuses: sdk/signature/strict_ed25519.c asks more. */
int crypto_sign_ed25519_open(unsigned char *m, unsigned long long *mlen, const unsigned char *sm,
                             unsigned long long smlen, const unsigned char *pk);

#endif /* THIRD_PARTY_OPENSSH_ED25519_H */
