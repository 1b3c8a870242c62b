#include "signature/strict_ed25519.h"

#include <string.h>

#include "signature/sha512.h"
#include "third_party/openssh_ed25519/ed25519.h"

enum { kSignatureBytes = 64, kNumberBytes = 32 };

/* Little-endian numbers: the field's p = 2^255 - 19, and the order of the base point. */
static const uint8_t kPrime[kNumberBytes] = {0xed, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
                                             0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
                                             0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f};
static const uint8_t kOrder[kNumberBytes] = {0xed, 0xd3, 0xf5, 0x5c, 0x1a, 0x63, 0x12, 0x58, 0xd6, 0x9c, 0xf7,
                                             0xa2, 0xde, 0xf9, 0xde, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                                             0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x10};

/* y of the points whose order divides 8: 0 (order 4), 1 (1), p - 1 (2), and two of order 8. */
static const uint8_t kSmallOrder[5][kNumberBytes] = {
    {0},
    {1},
    {0xec, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
     0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f},
    {0x26, 0xe8, 0x95, 0x8f, 0xc2, 0xb2, 0x27, 0xb0, 0x45, 0xc3, 0xf4, 0x89, 0xf2, 0xef, 0x98, 0xf0,
     0xd5, 0xdf, 0xac, 0x05, 0xd3, 0xc6, 0x33, 0x39, 0xb1, 0x38, 0x02, 0x88, 0x6d, 0x53, 0xfc, 0x05},
    {0xc7, 0x17, 0x6a, 0x70, 0x3d, 0x4d, 0xd8, 0x4f, 0xba, 0x3c, 0x0b, 0x76, 0x0d, 0x10, 0x67, 0x0f,
     0x2a, 0x20, 0x53, 0xfa, 0x2c, 0x39, 0xcc, 0xc6, 0x4e, 0xc7, 0xfd, 0x77, 0x92, 0xac, 0x03, 0x7a}};

int sphc_vendored_hash_sha512(unsigned char out[64], const unsigned char *in, unsigned long long in_bytes) {
  sphc_sha512(in, (size_t)in_bytes, out);
  return 0;
}

static int is_below(const uint8_t number[kNumberBytes], const uint8_t bound[kNumberBytes]) {
  int i = kNumberBytes - 1;
  while (i > 0 && number[i] == bound[i]) --i;
  return number[i] < bound[i];
}

static int is_equal(const uint8_t a[kNumberBytes], const uint8_t b[kNumberBytes]) {
  for (int i = 0; i < kNumberBytes; ++i)
    if (a[i] != b[i]) return 0;
  return 1;
}

/* Of a key as of R. */
static int is_good_point(const uint8_t point[kNumberBytes]) {
  uint8_t y[kNumberBytes];
  memcpy(y, point, sizeof y);
  y[kNumberBytes - 1] &= 0x7f; /* the top bit is the sign of x */
  if (!is_below(y, kPrime)) return 0;
  for (int i = 0; i < 5; ++i)
    if (is_equal(y, kSmallOrder[i])) return 0;
  return 1;
}

int sphc_ed25519_is_good_key(const uint8_t key[32]) { return is_good_point(key); }

int sphc_ed25519_verify(const uint8_t key[32], const void *message, size_t message_bytes,
                        const uint8_t signature[64]) {
  uint8_t is_signed[kSignatureBytes + SPHC_ED25519_MESSAGE_MAX], opened[sizeof is_signed];
  unsigned long long opened_bytes = 0;
  if (message_bytes > SPHC_ED25519_MESSAGE_MAX) return 0;
  if (!is_good_point(key) || !is_good_point(signature) || !is_below(signature + kNumberBytes, kOrder)) return 0;
  memcpy(is_signed, signature, kSignatureBytes);
  if (message_bytes) memcpy(is_signed + kSignatureBytes, message, message_bytes);
  return crypto_sign_ed25519_open(opened, &opened_bytes, is_signed, kSignatureBytes + message_bytes, key) == 0;
}
