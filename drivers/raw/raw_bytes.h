/* raw_bytes.h - numbers as they lie in a raw recording, whatever the processor: for raw.c and raw_writer.c alone.
 */
#ifndef SPHERECLOUD_DRIVERS_RAW_RAW_BYTES_H
#define SPHERECLOUD_DRIVERS_RAW_RAW_BYTES_H

#include <spherecloud/spherecloud.h>
#include <string.h>

enum { kVersion = 1, kHeaderBytes = 320, kHeadBytes = 88, kCameraBytes = 112 }; /* docs/recording.md */

static inline sphc_status refuse(sphc_message *message, sphc_status status, const char *text) {
  if (message) {
    strncpy(message->text, text, SPHC_MESSAGE_BYTES - 1);
    message->text[SPHC_MESSAGE_BYTES - 1] = '\0';
  }
  return status;
}

static inline uint32_t get32(const uint8_t *bytes) {
  return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static inline uint64_t get64(const uint8_t *bytes) { return (uint64_t)get32(bytes + 4) << 32 | get32(bytes); }

static inline double get_double(const uint8_t *bytes) {
  const uint64_t bits = get64(bytes);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static inline void put32(uint8_t *bytes, uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[i] = (uint8_t)(value >> (8 * i));
}

static inline void put64(uint8_t *bytes, uint64_t value) {
  put32(bytes, (uint32_t)value);
  put32(bytes + 4, (uint32_t)(value >> 32));
}

static inline void put_double(uint8_t *bytes, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  put64(bytes, bits);
}

/* CRC-32 of zlib, by nibbles; begin with 0. */
static inline uint32_t crc32_of(uint32_t crc, const uint8_t *bytes, size_t count) {
  static const uint32_t kTable[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu, 0x76DC4190u, 0x6B6B51F4u,
                                      0x4DB26158u, 0x5005713Cu, 0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                      0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};
  crc = ~crc;
  for (size_t i = 0; i < count; ++i) {
    crc = kTable[(crc ^ bytes[i]) & 15] ^ crc >> 4;
    crc = kTable[(crc ^ bytes[i] >> 4) & 15] ^ crc >> 4;
  }
  return ~crc;
}

/* Of unit length, with an offset that is a number. */
static inline int is_rigid(const sphc_rigid *rigid) {
  double squared = 0;
  int good = 1;
  for (size_t i = 0; i < 4; ++i) squared += rigid->q_wxyz[i] * rigid->q_wxyz[i];
  for (size_t i = 0; i < 3; ++i) good = good && rigid->t_m[i] >= -1e9 && rigid->t_m[i] <= 1e9;
  return good && squared >= 0.998 && squared <= 1.002;
}

static inline int is_color_format(sphc_format format) {
  return format == SPHC_FORMAT_GRAY8 || format == SPHC_FORMAT_RGB8 || format == SPHC_FORMAT_BGR8;
}

static inline size_t image_bytes(const sphc_camera *camera, sphc_format format) {
  return (size_t)camera->width * camera->height * sphc_format_bytes(format);
}

static inline size_t frame_bytes_of(const sphc_rig *rig, sphc_format color_format) {
  return kHeadBytes + image_bytes(&rig->depth_camera, SPHC_FORMAT_DEPTH16) +
         image_bytes(&rig->color_camera, color_format);
}

static inline uint64_t place_of(uint32_t index, size_t frame_bytes) {
  return kHeaderBytes + (uint64_t)index * frame_bytes;
}

#endif /* SPHERECLOUD_DRIVERS_RAW_RAW_BYTES_H */
