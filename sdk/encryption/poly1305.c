#include "encryption/poly1305.h"

#include <string.h>

#include "encryption/wipe.h"

enum { kBlockBytes = 16, kLimbs = 5, kLimbBits = 26 };
static const uint32_t kLimbMask = (1u << kLimbBits) - 1;

/* 128 bits, little-endian. */
static void split(const uint8_t bytes[kBlockBytes], uint32_t limbs[kLimbs]) {
  uint64_t bits = 0;
  int have = 0, limb = 0;
  for (int i = 0; i < kBlockBytes; ++i) {
    bits |= (uint64_t)bytes[i] << have;
    have += 8;
    if (have < kLimbBits) continue;
    limbs[limb++] = (uint32_t)bits & kLimbMask;
    bits >>= kLimbBits;
    have -= kLimbBits;
  }
  limbs[limb] = (uint32_t)bits;
}

/* Brings limbs below 2^26, the second one but little above; what is over 2^130 comes back five times. */
static void carry(uint64_t wide[kLimbs], uint32_t limbs[kLimbs]) {
  uint64_t over = 0;
  for (int i = 0; i < kLimbs; ++i) {
    wide[i] += over;
    over = wide[i] >> kLimbBits;
    limbs[i] = (uint32_t)wide[i] & kLimbMask;
  }
  over = limbs[0] + 5 * over;
  limbs[0] = (uint32_t)over & kLimbMask;
  limbs[1] += (uint32_t)(over >> kLimbBits);
}

/* sum = (sum + block) r.  2^130 is 5, so limbs that would lie beyond the fifth come back five times. */
static void add_block(sphc_poly1305 *state, const uint8_t block[kBlockBytes]) {
  uint32_t *limbs = state->limbs;
  uint64_t *wide = state->wide;
  split(block, limbs);
  limbs[4] |= 1u << 24; /* the bit behind the block */
  for (int i = 0; i < kLimbs; ++i) limbs[i] += state->sum[i];
  for (int i = 0; i < kLimbs; ++i) {
    wide[i] = 0;
    for (int j = 0; j <= i; ++j) wide[i] += (uint64_t)limbs[j] * state->r[i - j];
    for (int j = i + 1; j < kLimbs; ++j) wide[i] += (uint64_t)limbs[j] * (5 * state->r[kLimbs + i - j]);
  }
  carry(wide, state->sum);
}

void sphc_poly1305_init(sphc_poly1305 *state, const uint8_t key[32]) {
  uint8_t r[kBlockBytes];
  memcpy(r, key, sizeof r);
  for (int i = 3; i < kBlockBytes; i += 4) r[i] &= 15;
  for (int i = 4; i < kBlockBytes; i += 4) r[i] &= 252;
  split(r, state->r);
  memset(state->sum, 0, sizeof state->sum);
  memcpy(state->pad, key + kBlockBytes, sizeof state->pad);
  sphc_wipe(r, sizeof r);
}

void sphc_poly1305_add_padded(sphc_poly1305 *state, const uint8_t *data, size_t bytes) {
  for (; bytes >= kBlockBytes; data += kBlockBytes, bytes -= kBlockBytes) add_block(state, data);
  if (bytes == 0) return;
  uint8_t last[kBlockBytes] = {0};
  memcpy(last, data, bytes);
  add_block(state, last);
}

/* The sum modulo 2^130 - 5, in the limbs: that of it and of it + 5 - 2^130 which is not negative. */
static void reduce(sphc_poly1305 *state) {
  uint32_t *limbs = state->limbs, *less = state->sum, over = 5;
  for (int i = 0; i < kLimbs; ++i) state->wide[i] = state->sum[i];
  carry(state->wide, limbs); /* now every limb is below 2^26 */
  for (int i = 0; i < kLimbs; ++i) {
    over += limbs[i];
    less[i] = over & kLimbMask;
    over >>= kLimbBits;
  }
  const uint32_t take_less = 0u - over; /* all ones where the sum is 2^130 - 5 or more */
  for (int i = 0; i < kLimbs; ++i) limbs[i] = (limbs[i] & ~take_less) | (less[i] & take_less);
}

void sphc_poly1305_tag(sphc_poly1305 *state, uint8_t tag[16]) {
  uint32_t over = 0;
  uint64_t bits = 0;
  int have = 0, limb = 0;
  reduce(state);
  for (int i = 0; i < kBlockBytes; ++i) {
    if (have < 8) {
      bits |= (uint64_t)state->limbs[limb++] << have;
      have += kLimbBits;
    }
    over += (uint32_t)(bits & 255) + state->pad[i];
    tag[i] = (uint8_t)over;
    over >>= 8;
    bits >>= 8;
    have -= 8;
  }
}
