#include "encryption/chacha20.h"

#include <string.h>

#include "encryption/wipe.h"

enum { kBlockBytes = 64, kDoubleRounds = 10 };

static uint32_t get32(const uint8_t *bytes) {
  return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static void put32(uint32_t value, uint8_t *bytes) {
  for (int i = 0; i < 4; ++i, value >>= 8) bytes[i] = (uint8_t)value;
}

static uint32_t rotate(uint32_t value, int bits) { return value << bits | value >> (32 - bits); }

static void quarter_round(uint32_t words[16], int a, int b, int c, int d) {
  words[a] += words[b], words[d] = rotate(words[d] ^ words[a], 16);
  words[c] += words[d], words[b] = rotate(words[b] ^ words[c], 12);
  words[a] += words[b], words[d] = rotate(words[d] ^ words[a], 8);
  words[c] += words[d], words[b] = rotate(words[b] ^ words[c], 7);
}

/* Columns, then diagonals. */
static void all_rounds(uint32_t words[16]) {
  for (int round = 0; round < kDoubleRounds; ++round) {
    for (int i = 0; i < 4; ++i) quarter_round(words, i, 4 + i, 8 + i, 12 + i);
    for (int i = 0; i < 4; ++i) quarter_round(words, i, 4 + (i + 1) % 4, 8 + (i + 2) % 4, 12 + (i + 3) % 4);
  }
}

/* Constants, key, and the last four words. */
static void start(const uint8_t key[32], const uint8_t last[16], uint32_t words[16]) {
  static const uint32_t kConstants[4] = {0x61707865u, 0x3320646eu, 0x79622d32u,
                                         0x6b206574u}; /* "expand 32-byte k" */
  memcpy(words, kConstants, sizeof kConstants);
  for (int i = 0; i < 8; ++i) words[4 + i] = get32(key + 4 * i);
  for (int i = 0; i < 4; ++i) words[12 + i] = get32(last + 4 * i);
}

void sphc_chacha20_xor(const uint8_t key[32], const uint8_t nonce[12], uint32_t counter, const uint8_t *in,
                       uint8_t *out, size_t bytes) {
  uint32_t first[16], words[16];
  uint8_t last[16], stream[kBlockBytes];
  put32(counter, last);
  memcpy(last + 4, nonce, 12);
  start(key, last, first);
  for (size_t at = 0; at < bytes; at += kBlockBytes, ++first[12]) {
    const size_t count = bytes - at < kBlockBytes ? bytes - at : kBlockBytes;
    memcpy(words, first, sizeof words);
    all_rounds(words);
    for (int i = 0; i < 16; ++i) put32(words[i] + first[i], stream + 4 * i);
    for (size_t i = 0; i < count; ++i) out[at + i] = (uint8_t)(in[at + i] ^ stream[i]);
  }
  sphc_wipe(first, sizeof first);
  sphc_wipe(words, sizeof words);
  sphc_wipe(stream, sizeof stream);
}

void sphc_hchacha20(const uint8_t key[32], const uint8_t input[16], uint8_t derived[32]) {
  uint32_t words[16];
  start(key, input, words);
  all_rounds(words);
  for (int i = 0; i < 4; ++i) put32(words[i], derived + 4 * i);
  for (int i = 0; i < 4; ++i) put32(words[12 + i], derived + 16 + 4 * i);
  sphc_wipe(words, sizeof words);
}
