#include <string.h>

#include "signature/sha512.h"
#include "signature/statement.h"
#include "signature/strict_ed25519.h"
#include "spherecloud/spherecloud_signature.h"

static sphc_status refuse(sphc_message *message, sphc_status status, const char *text) {
  if (message) {
    size_t i = 0;
    for (; text[i] && i < SPHC_MESSAGE_BYTES - 1; ++i) message->text[i] = text[i];
    message->text[i] = '\0';
  }
  return status;
}

static int is_equal(const uint8_t *a, const uint8_t *b, size_t bytes) {
  for (size_t i = 0; i < bytes; ++i)
    if (a[i] != b[i]) return 0;
  return 1;
}

const char *sphc_signature_status_name(sphc_status status) {
  switch (status) {
    case SPHC_E_SIGNATURE_MISSING:
      return "SPHC_E_SIGNATURE_MISSING";
    case SPHC_E_SIGNATURE_FORMAT:
      return "SPHC_E_SIGNATURE_FORMAT";
    case SPHC_E_SIGNATURE_KEY:
      return "SPHC_E_SIGNATURE_KEY";
    case SPHC_E_SIGNATURE_FORGED:
      return "SPHC_E_SIGNATURE_FORGED";
    case SPHC_E_SIGNATURE_MAP:
      return "SPHC_E_SIGNATURE_MAP";
    case SPHC_E_SIGNATURE_NAME:
      return "SPHC_E_SIGNATURE_NAME";
    case SPHC_E_SIGNATURE_RELEASE:
      return "SPHC_E_SIGNATURE_RELEASE";
    default:
      return sphc_status_name(status);
  }
}

sphc_status sphc_signature_policy_init(sphc_signature_policy *policy, size_t struct_size) {
  if (!policy) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *policy) return SPHC_E_STRUCT_SIZE;
  memset(policy, 0, sizeof *policy);
  policy->struct_size = (uint32_t)struct_size;
  return SPHC_OK;
}

/* ---- the policy, and what is asked by it ---- */

static sphc_status check_policy(const sphc_signature_policy *policy, sphc_message *message) {
  if (!policy || (policy->struct_size == sizeof *policy && !policy->keys))
    return refuse(message, SPHC_E_ARGUMENT, "policy or policy.keys is null; give the keys that are trusted");
  if (policy->struct_size != sizeof *policy)
    return refuse(message, SPHC_E_STRUCT_SIZE,
                  "policy.struct_size is not the size of sphc_signature_policy; call sphc_signature_policy_init");
  if (policy->key_count < 1 || policy->key_count > SPHC_SIGNATURE_KEYS_MAX)
    return refuse(message, SPHC_E_ARGUMENT, "policy.key_count is not 1 to SPHC_SIGNATURE_KEYS_MAX");
  for (uint32_t i = 0; i < policy->key_count; ++i)
    if (!sphc_ed25519_is_good_key(policy->keys[i].bytes))
      return refuse(message, SPHC_E_ARGUMENT,
                    "a key of policy.keys is no public key of Ed25519, or one for which anybody can sign; take the "
                    "bytes that `spherecloud key` prints");
  if (policy->name) {
    size_t length = 0;
    while (length < SPHC_SIGNATURE_NAME_BYTES && policy->name[length]) ++length;
    if (length == SPHC_SIGNATURE_NAME_BYTES)
      return refuse(message, SPHC_E_ARGUMENT, "policy.name has more than 31 bytes, and no map has such a name");
  }
  return SPHC_OK;
}

/* Which key of the list has this id; key_count: none. */
static uint32_t key_by_id(const sphc_signature_policy *policy, const uint8_t key_id[SPHC_KEY_ID_BYTES]) {
  uint32_t index = 0;
  for (; index < policy->key_count; ++index) {
    uint8_t id[SPHC_KEY_ID_BYTES];
    sphc_statement_key_id(policy->keys[index].bytes, id);
    if (is_equal(id, key_id, sizeof id)) break;
  }
  return index;
}

static int has_name(const sphc_statement *said, const char *name) {
  size_t i = 0;
  if (!name) return 1;
  for (; name[i]; ++i)
    if (said->name[i] != name[i]) return 0;
  return !said->name[i];
}

/* Who signed what?  Nothing of `said` is believed before the signature fits. */
static sphc_status check_signature(const sphc_signature_policy *policy, const uint8_t *signature,
                                   sphc_statement *said, uint32_t *key_index, sphc_message *message) {
  if (!sphc_statement_read(signature, said))
    return refuse(message, SPHC_E_SIGNATURE_FORMAT,
                  "this is no signature of a map, or one of another version; sign the map with this release's "
                  "`spherecloud sign`");
  *key_index = key_by_id(policy, said->key_id);
  if (*key_index == policy->key_count)
    return refuse(message, SPHC_E_SIGNATURE_KEY,
                  "the map is signed by a key that is not trusted; take a map of the trusted owner, or add that "
                  "owner's public key to the trust list");
  if (!sphc_ed25519_verify(policy->keys[*key_index].bytes, signature, SPHC_STATEMENT_BYTES,
                           signature + SPHC_STATEMENT_BYTES))
    return refuse(message, SPHC_E_SIGNATURE_FORGED,
                  "the signature was not made by the key that it names, or was changed since; get the map and its "
                  "signature anew from the owner");
  return SPHC_OK;
}

static sphc_status check_statement(const sphc_signature_policy *policy, const sphc_statement *said, const void *map,
                                   size_t map_bytes, sphc_message *message) {
  uint8_t hash[SPHC_SHA512_BYTES];
  if (!has_name(said, policy->name))
    return refuse(message, SPHC_E_SIGNATURE_NAME,
                  "the map is signed under another name than the one asked for; take the map of this name");
  if (said->release < policy->least_release)
    return refuse(message, SPHC_E_SIGNATURE_RELEASE,
                  "the map is of an older release than the least that is accepted; take the owner's latest map");
  if (said->map_bytes == map_bytes) {
    sphc_sha512(map, map_bytes, hash);
    if (is_equal(hash, said->map_sha512, sizeof hash)) return SPHC_OK;
  }
  return refuse(message, SPHC_E_SIGNATURE_MAP,
                "the signature is of another map, or the map was changed since; get both anew from the owner");
}

sphc_status sphc_signature_verify(const sphc_signature_policy *policy, const void *map, size_t map_bytes,
                                  const void *signature, size_t signature_bytes,
                                  sphc_signature_statement *statement, sphc_message *message) {
  sphc_statement said;
  uint32_t key_index = 0;
  sphc_status status = check_policy(policy, message);
  if (status != SPHC_OK) return status;
  if (!map) return refuse(message, SPHC_E_ARGUMENT, "map is null; give the bytes of the map file");
  if (statement && statement->struct_size != sizeof *statement)
    return refuse(message, SPHC_E_STRUCT_SIZE, "statement.struct_size is not the size of sphc_signature_statement");
  if (!signature || signature_bytes == 0)
    return refuse(message, SPHC_E_SIGNATURE_MISSING,
                  "the map is not signed, and only signed maps are accepted; sign it with `spherecloud sign`");
  if (signature_bytes != SPHC_SIGNATURE_BYTES)
    return refuse(message, SPHC_E_SIGNATURE_FORMAT,
                  "a signature has SPHC_SIGNATURE_BYTES bytes, and this has not; get it anew from the owner");
  status = check_signature(policy, (const uint8_t *)signature, &said, &key_index, message);
  if (status == SPHC_OK) status = check_statement(policy, &said, map, map_bytes, message);
  if (status != SPHC_OK || !statement) return status;
  statement->key_index = key_index;
  statement->release = said.release;
  memcpy(statement->name, said.name, sizeof statement->name);
  return SPHC_OK;
}

sphc_status sphc_signature_open_map(const sphc_signature_policy *policy, void *memory, size_t memory_bytes,
                                    const void *file, size_t file_bytes, const void *signature,
                                    size_t signature_bytes, sphc_map **map, sphc_signature_statement *statement,
                                    sphc_message *message) {
  sphc_signature_statement said;
  if (statement) said = *statement;
  sphc_status status = sphc_signature_verify(policy, file, file_bytes, signature, signature_bytes,
                                             statement ? &said : NULL, message);
  if (status == SPHC_OK) status = sphc_map_init(memory, memory_bytes, file, file_bytes, map, message);
  if (status == SPHC_OK && statement) *statement = said;
  return status;
}
