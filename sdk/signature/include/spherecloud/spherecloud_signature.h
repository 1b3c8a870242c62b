/* spherecloud_signature.h - refuses maps that nobody you trust has signed.  A static library of its own,
 * libspherecloud_signature.a: programs that do not want it do not pay for it.
 *
 * A map file stays as it is.  Beside it, or behind it in one file, stand SPHC_SIGNATURE_BYTES bytes that
 * `spherecloud sign` made: an Ed25519 signature (RFC 8032) of a statement about the map.  The statement holds the
 * SHA-512 of all bytes of the map, their number, which key signed, a name of the map and a release number that only
 * grows.  docs/signatures.md has the format, and how keys are made, kept and changed.
 *
 * The program states a policy once: whom it trusts, which map it wants, and which release is the least.
 *
 *     static const sphc_signature_key keys[] = {{{ ...32 bytes... }}, {{ ...the key to come... }}};
 *
 *     sphc_signature_policy_init(&policy, sizeof policy);
 *     policy.keys = keys;
 *     policy.key_count = 2;
 *     policy.least_release = release_that_was_used_last;
 *     sphc_signature_open_map(&policy, memory, sizeof memory, file, file_bytes, signature, signature_bytes, &map,
 *                             &statement, &message);
 *
 * Where sphc_signature_open_map is the only call by which a program opens maps, it has no map that was not
 * verified. There is no policy that takes an unsigned map.
 *
 * Time of check.  The map's bytes must not change between the call and sphc_map_fini.  Verify bytes in memory that
 * nobody else writes; a file that others can write may not be mapped (mmap), but has to be read.
 *
 * Memory: about 14 kB of stack, no heap, nothing global.  Time: one Ed25519 verification and one reading of the
 * map. What is compared is public, so times tell nothing secret.
 *
 * Conventions are those of spherecloud.h: status < 0 is a failure, and outputs are untouched but for the message.
 * The library is static, so it and its header are of one release: struct_size must be sizeof.  SPHC_SIGNATURE_ABI
 * is raised when a program would have to be changed.
 */
#ifndef SPHERECLOUD_SPHERECLOUD_SIGNATURE_H
#define SPHERECLOUD_SPHERECLOUD_SIGNATURE_H

#include <spherecloud/spherecloud.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPHC_SIGNATURE_ABI 1u
#define SPHC_SIGNATURE_BYTES 208u   /* of a signature file, always */
#define SPHC_SIGNATURE_KEYS_MAX 16u /* of a trust list */
#define SPHC_SIGNATURE_NAME_BYTES 32u

/* Statuses of this library; those of spherecloud.h are never between -60 and -69.  A map whose status is one of
 * these must not be used. */
enum {
  SPHC_E_SIGNATURE_MISSING = -60, /* the map is not signed: no bytes were given */
  SPHC_E_SIGNATURE_FORMAT = -61,  /* not a signature of this version, or cut short */
  SPHC_E_SIGNATURE_KEY = -62,     /* made by a key that is not on the trust list */
  SPHC_E_SIGNATURE_FORGED = -63,  /* not made by the key that it names, or changed since */
  SPHC_E_SIGNATURE_MAP = -64,     /* of other bytes than these: another map, or a changed one */
  SPHC_E_SIGNATURE_NAME = -65,    /* of a map with another name */
  SPHC_E_SIGNATURE_RELEASE = -66  /* an older release than the least that is accepted */
};

/* An Ed25519 public key, as `spherecloud key` prints it.  Keeps its layout for ever. */
typedef struct sphc_signature_key {
  uint8_t bytes[32];
} sphc_signature_key;

/* What a program accepts. */
typedef struct sphc_signature_policy {
  uint32_t struct_size;
  uint32_t key_count;             /* 1 to SPHC_SIGNATURE_KEYS_MAX */
  const sphc_signature_key *keys; /* whoever holds the secret of one of them is believed; borrowed */
  uint64_t least_release; /* 0: any.  Keep the release of the map that was used last where an attacker cannot
                             set it back, and give it here */
  const char *name;       /* the map must have been signed under this name; null: under any; borrowed */
} sphc_signature_policy;

/* What was signed.  Told of a map that is accepted, and of no other. */
typedef struct sphc_signature_statement {
  uint32_t struct_size;
  uint32_t key_index; /* of policy.keys */
  uint64_t release;
  char name[32]; /* ends with a zero; empty where the map has no name */
} sphc_signature_statement;

/* "SPHC_E_SIGNATURE_KEY" and so on; of other statuses as sphc_status_name; never null; static storage. [pure] */
const char *sphc_signature_status_name(sphc_status status);

/* Zeroes and the size: no key, any release from 0 on, any name.  SPHC_E_STRUCT_SIZE when that is not the
 * struct's. [pure] */
sphc_status sphc_signature_policy_init(sphc_signature_policy *policy, size_t struct_size);

/* Whether the policy accepts the map of `map_bytes` bytes at `map`, with the signature of `signature_bytes` bytes
 * at `signature` (null or 0 bytes: none).  `statement` may be null; else set its struct_size first.  `message` may
 * be null and gets cause and cure.  The cheap checks come first, the map's bytes are read last. Errors:
 * SPHC_E_SIGNATURE_..., ARGUMENT (null, no key, too many, a key that is no good one, a name too long), STRUCT_SIZE.
 * [pure] */
sphc_status sphc_signature_verify(const sphc_signature_policy *policy, const void *map, size_t map_bytes,
                                  const void *signature, size_t signature_bytes,
                                  sphc_signature_statement *statement, sphc_message *message);

/* sphc_signature_verify, and where it accepts the map, sphc_map_init with memory, file and map as there: a map that
 * is refused is not even read by the map's reader.  Errors: those of both. [pure] */
sphc_status sphc_signature_open_map(const sphc_signature_policy *policy, void *memory, size_t memory_bytes,
                                    const void *file, size_t file_bytes, const void *signature,
                                    size_t signature_bytes, sphc_map **map, sphc_signature_statement *statement,
                                    sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_SPHERECLOUD_SIGNATURE_H */
