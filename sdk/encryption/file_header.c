#include "encryption/file_header.h"

#include <string.h>

#include "encryption/chacha20.h"
#include "encryption/wipe.h"

/* Offsets in the file. */
enum { kTag = 0, kMapBytes = 16, kKeyId = 24, kNonce = 40 };
static const uint8_t kTagText[16] = {'S', 'P', 'H', 'E', 'R', 'E', 'C', 'L',
                                     'O', 'U', 'D', '-', 'E', 'N', 'C', '1'};

void sphc_encryption_key_id(const sphc_encryption_key *key, uint8_t key_id[SPHC_ENCRYPTION_KEY_ID_BYTES]) {
  static const uint8_t kInput[16] = {'S', 'P', 'H', 'E', 'R', 'E', 'C', 'L',
                                     'O', 'U', 'D', '-', 'K', 'E', 'Y', '1'};
  uint8_t derived[32];
  sphc_hchacha20(key->bytes, kInput, derived);
  memcpy(key_id, derived, SPHC_ENCRYPTION_KEY_ID_BYTES);
  sphc_wipe(derived, sizeof derived);
}

void sphc_encryption_header_write(const sphc_encryption_header *header,
                                  uint8_t bytes[SPHC_ENCRYPTION_HEADER_BYTES]) {
  memcpy(bytes + kTag, kTagText, sizeof kTagText);
  for (int i = 0; i < 8; ++i) bytes[kMapBytes + i] = (uint8_t)(header->map_bytes >> 8 * i);
  memcpy(bytes + kKeyId, header->key_id, sizeof header->key_id);
  memcpy(bytes + kNonce, header->nonce, sizeof header->nonce);
}

int sphc_encryption_header_read(const uint8_t bytes[SPHC_ENCRYPTION_HEADER_BYTES], sphc_encryption_header *header) {
  if (memcmp(bytes + kTag, kTagText, sizeof kTagText) != 0) return 0;
  header->map_bytes = 0;
  for (int i = 7; i >= 0; --i) header->map_bytes = header->map_bytes << 8 | bytes[kMapBytes + i];
  memcpy(header->key_id, bytes + kKeyId, sizeof header->key_id);
  memcpy(header->nonce, bytes + kNonce, sizeof header->nonce);
  return 1;
}
