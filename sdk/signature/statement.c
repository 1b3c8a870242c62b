#include "signature/statement.h"

#include <string.h>

/* Format and version.  Nothing else that a key of ours signs begins so. */
static const uint8_t kTag[16] = {'S', 'P', 'H', 'E', 'R', 'E', 'C', 'L', 'O', 'U', 'D', '-', 'S', 'I', 'G', '1'};
enum { kRelease = 16, kMapBytes = 24, kKeyId = 32, kName = 48, kMapSha512 = 80 };

static uint64_t get64(const uint8_t *bytes) {
  uint64_t value = 0;
  for (int i = 7; i >= 0; --i) value = value << 8 | bytes[i];
  return value;
}

static void put64(uint64_t value, uint8_t *bytes) {
  for (int i = 0; i < 8; ++i, value >>= 8) bytes[i] = (uint8_t)value;
}

void sphc_statement_key_id(const uint8_t key[32], uint8_t key_id[SPHC_KEY_ID_BYTES]) {
  uint8_t hash[SPHC_SHA512_BYTES];
  sphc_sha512(key, 32, hash);
  memcpy(key_id, hash, SPHC_KEY_ID_BYTES);
}

void sphc_statement_write(const sphc_statement *statement, uint8_t bytes[SPHC_STATEMENT_BYTES]) {
  memcpy(bytes, kTag, sizeof kTag);
  put64(statement->release, bytes + kRelease);
  put64(statement->map_bytes, bytes + kMapBytes);
  memcpy(bytes + kKeyId, statement->key_id, sizeof statement->key_id);
  memcpy(bytes + kName, statement->name, sizeof statement->name);
  memcpy(bytes + kMapSha512, statement->map_sha512, sizeof statement->map_sha512);
}

/* Ends with a zero, and nothing stands behind the first one. */
static int is_name(const uint8_t name[SPHC_SIGNATURE_NAME_BYTES]) {
  for (int i = 1; i < (int)SPHC_SIGNATURE_NAME_BYTES; ++i)
    if (name[i] && !name[i - 1]) return 0;
  return name[SPHC_SIGNATURE_NAME_BYTES - 1] == 0;
}

int sphc_statement_read(const uint8_t bytes[SPHC_STATEMENT_BYTES], sphc_statement *statement) {
  for (size_t i = 0; i < sizeof kTag; ++i)
    if (bytes[i] != kTag[i]) return 0;
  if (!is_name(bytes + kName)) return 0;
  statement->release = get64(bytes + kRelease);
  statement->map_bytes = get64(bytes + kMapBytes);
  memcpy(statement->key_id, bytes + kKeyId, sizeof statement->key_id);
  memcpy(statement->name, bytes + kName, sizeof statement->name);
  memcpy(statement->map_sha512, bytes + kMapSha512, sizeof statement->map_sha512);
  return 1;
}
