/* spherecloud_encryption.h - decrypts maps that lie encrypted on a device.  A static library of its own,
 * libspherecloud_encryption.a: programs that do not want it do not pay for it.
 *
 * `spherecloud encrypt` makes X.sphc.enc of X.sphc with a secret key of 32 bytes: XChaCha20-Poly1305 (RFC 8439 with
 * the nonce of draft-irtf-cfrg-xchacha-03).  docs/encryption.md has the format, and says what it protects: whoever
 * has the storage and not the key.
 *
 *     sphc_encryption_decrypt(&key, file, file_bytes, file + SPHC_ENCRYPTION_HEADER_BYTES,
 *                             file_bytes - SPHC_ENCRYPTION_ADDED_BYTES, &message);     in place
 *     sphc_map_init(memory, memory_bytes, file + SPHC_ENCRYPTION_HEADER_BYTES, ...);
 *
 * A file that was changed, or is of another key, is refused before one byte of it is decrypted.
 *
 * Memory: less than 1 kB of stack, no heap, nothing global.  Time: the file is read twice.  Times and addresses do
 * not depend on the key or on the map, but on the file's size and on whether it is accepted.  What was derived from
 * the key in memory is wiped; the key and the decrypted map are the caller's to wipe.
 *
 * Conventions are those of spherecloud.h: status < 0 is a failure, and outputs are untouched but for the message.
 * SPHC_ENCRYPTION_ABI is raised when a program would have to be changed.
 */
#ifndef SPHERECLOUD_SPHERECLOUD_ENCRYPTION_H
#define SPHERECLOUD_SPHERECLOUD_ENCRYPTION_H

#include <spherecloud/spherecloud.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPHC_ENCRYPTION_ABI 1u
/* Bytes before the map: a file that is aligned as a map must be decrypts in place to one that is. */
#define SPHC_ENCRYPTION_HEADER_BYTES 64u
/* Header and tag: an encrypted file has so many bytes more than its map. */
#define SPHC_ENCRYPTION_ADDED_BYTES 80u

/* Statuses of this library; those of spherecloud.h are never between -70 and -79. */
enum {
  SPHC_E_ENCRYPTION_FORMAT = -70, /* not an encrypted map of this version, or cut short */
  SPHC_E_ENCRYPTION_KEY = -71,    /* encrypted with another key */
  SPHC_E_ENCRYPTION_CHANGED = -72 /* changed since it was encrypted */
};

/* A secret key, as `spherecloud key --for encryption` draws it.  Keeps its layout for ever. */
typedef struct sphc_encryption_key {
  uint8_t bytes[32];
} sphc_encryption_key;

/* "SPHC_E_ENCRYPTION_KEY" and so on; of other statuses as sphc_status_name; never null; static storage. [pure] */
const char *sphc_encryption_status_name(sphc_status status);

/* Decrypts the `file_bytes` bytes at `file` into the `map_bytes` bytes at `map`, which are file_bytes -
 * SPHC_ENCRYPTION_ADDED_BYTES.  `map` is file + SPHC_ENCRYPTION_HEADER_BYTES, which decrypts in place, or does not
 * overlap the file.  `message` may be null and gets cause and cure.  A file that is refused leaves `map` as it was.
 * Errors: SPHC_E_ENCRYPTION_..., ARGUMENT (null, another size, ranges that overlap). [pure] */
sphc_status sphc_encryption_decrypt(const sphc_encryption_key *key, const void *file, size_t file_bytes, void *map,
                                    size_t map_bytes, sphc_message *message);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_SPHERECLOUD_ENCRYPTION_H */
