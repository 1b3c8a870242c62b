#include "encryption/aead.h"

#include <string.h>

#include "encryption/chacha20.h"
#include "encryption/poly1305.h"
#include "encryption/wipe.h"

static void put64(uint64_t value, uint8_t *bytes) {
  for (int i = 0; i < 8; ++i, value >>= 8) bytes[i] = (uint8_t)value;
}

static void tag_of(const uint8_t key[32], const uint8_t nonce[12], const sphc_aead_text *text, uint8_t tag[16]) {
  sphc_poly1305 sum;
  uint8_t once[32] = {0}, lengths[16];
  sphc_chacha20_xor(key, nonce, 0, once, once, sizeof once);
  sphc_poly1305_init(&sum, once);
  sphc_poly1305_add_padded(&sum, text->header, text->header_bytes);
  sphc_poly1305_add_padded(&sum, text->cipher, text->bytes);
  put64(text->header_bytes, lengths);
  put64(text->bytes, lengths + 8);
  sphc_poly1305_add_padded(&sum, lengths, sizeof lengths);
  sphc_poly1305_tag(&sum, tag);
  sphc_wipe(once, sizeof once);
  sphc_wipe(&sum, sizeof sum);
}

int sphc_aead_open(const uint8_t key[32], const uint8_t nonce[SPHC_AEAD_NONCE_BYTES], const sphc_aead_text *text,
                   uint8_t *plain) {
  uint8_t derived[32], short_nonce[12] = {0}, tag[SPHC_AEAD_TAG_BYTES];
  uint32_t differs = 0;
  sphc_hchacha20(key, nonce, derived);
  memcpy(short_nonce + 4, nonce + 16, 8);
  tag_of(derived, short_nonce, text, tag);
  for (int i = 0; i < SPHC_AEAD_TAG_BYTES; ++i) differs |= (uint32_t)(tag[i] ^ text->tag[i]);
  if (!differs) sphc_chacha20_xor(derived, short_nonce, 1, text->cipher, plain, text->bytes);
  sphc_wipe(derived, sizeof derived);
  sphc_wipe(tag, sizeof tag); /* it would let anybody make a file that is accepted */
  return !differs;
}
