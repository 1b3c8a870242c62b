#include "encryption/aead.h"
#include "encryption/file_header.h"
#include "spherecloud/spherecloud_encryption.h"

static sphc_status refuse(sphc_message *message, sphc_status status, const char *text) {
  if (message) {
    size_t i = 0;
    for (; text[i] && i < SPHC_MESSAGE_BYTES - 1; ++i) message->text[i] = text[i];
    message->text[i] = '\0';
  }
  return status;
}

const char *sphc_encryption_status_name(sphc_status status) {
  switch (status) {
    case SPHC_E_ENCRYPTION_FORMAT:
      return "SPHC_E_ENCRYPTION_FORMAT";
    case SPHC_E_ENCRYPTION_KEY:
      return "SPHC_E_ENCRYPTION_KEY";
    case SPHC_E_ENCRYPTION_CHANGED:
      return "SPHC_E_ENCRYPTION_CHANGED";
    default:
      return sphc_status_name(status);
  }
}

/* In place, or apart. */
static int ranges_are_sound(const uint8_t *file, size_t file_bytes, const uint8_t *map, size_t map_bytes) {
  const uintptr_t file_at = (uintptr_t)file, map_at = (uintptr_t)map;
  if (map_at == file_at + SPHC_ENCRYPTION_HEADER_BYTES) return 1;
  return map_at < file_at ? file_at - map_at >= map_bytes : map_at - file_at >= file_bytes;
}

static sphc_status check_arguments(const sphc_encryption_key *key, const void *file, size_t file_bytes,
                                   const void *map, size_t map_bytes, sphc_message *message) {
  if (!key || !file || !map)
    return refuse(message, SPHC_E_ARGUMENT,
                  "key, file or map is null; give the secret key, the encrypted file, and room for the map");
  if (file_bytes < SPHC_ENCRYPTION_ADDED_BYTES)
    return refuse(message, SPHC_E_ENCRYPTION_FORMAT,
                  "the file is shorter than an encrypted map of no bytes; get it anew from the owner");
  if (map_bytes != file_bytes - SPHC_ENCRYPTION_ADDED_BYTES)
    return refuse(message, SPHC_E_ARGUMENT,
                  "map_bytes is not file_bytes - SPHC_ENCRYPTION_ADDED_BYTES; give room for just the map");
  if (!ranges_are_sound((const uint8_t *)file, file_bytes, (const uint8_t *)map, map_bytes))
    return refuse(message, SPHC_E_ARGUMENT,
                  "map overlaps the file; give memory apart from it, or file + SPHC_ENCRYPTION_HEADER_BYTES, which "
                  "decrypts in place");
  return SPHC_OK;
}

/* Nothing of a header is believed before the tag fits; it tells which error it is. */
static sphc_status check_header(const sphc_encryption_key *key, const uint8_t *file, size_t map_bytes,
                                sphc_encryption_header *header, sphc_message *message) {
  uint8_t id[SPHC_ENCRYPTION_KEY_ID_BYTES];
  int is_same = 1;
  if (!sphc_encryption_header_read(file, header))
    return refuse(message, SPHC_E_ENCRYPTION_FORMAT,
                  "this is no encrypted map, or one of another version; encrypt the map with this release's "
                  "`spherecloud encrypt`, or open it as it is");
  if (header->map_bytes != map_bytes)
    return refuse(message, SPHC_E_ENCRYPTION_FORMAT,
                  "the encrypted map has another size than it says, so it was cut or something was added; get it "
                  "anew from the owner");
  sphc_encryption_key_id(key, id);
  for (int i = 0; i < SPHC_ENCRYPTION_KEY_ID_BYTES; ++i) is_same &= id[i] == header->key_id[i];
  return is_same ? SPHC_OK
                 : refuse(message, SPHC_E_ENCRYPTION_KEY,
                          "the map is encrypted with another key; give the key that it was encrypted with");
}

sphc_status sphc_encryption_decrypt(const sphc_encryption_key *key, const void *file, size_t file_bytes, void *map,
                                    size_t map_bytes, sphc_message *message) {
  const uint8_t *bytes = (const uint8_t *)file;
  sphc_encryption_header header;
  sphc_status status = check_arguments(key, file, file_bytes, map, map_bytes, message);
  if (status == SPHC_OK) status = check_header(key, bytes, map_bytes, &header, message);
  if (status != SPHC_OK) return status;
  const sphc_aead_text text = {bytes, SPHC_ENCRYPTION_HEADER_BYTES, bytes + SPHC_ENCRYPTION_HEADER_BYTES, map_bytes,
                               bytes + SPHC_ENCRYPTION_HEADER_BYTES + map_bytes};
  if (sphc_aead_open(key->bytes, header.nonce, &text, (uint8_t *)map)) return SPHC_OK;
  return refuse(message, SPHC_E_ENCRYPTION_CHANGED,
                "the encrypted map was changed since it was encrypted; get it anew from the owner");
}
