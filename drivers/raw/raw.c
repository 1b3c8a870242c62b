#include "raw.h"

#include "raw_bytes.h"

/* ---- header ---- */

static void get_camera(const uint8_t *bytes, sphc_camera *camera) {
  camera->model = (sphc_camera_model)get32(bytes);
  camera->width = get32(bytes + 4);
  camera->height = get32(bytes + 8);
  camera->param_count = get32(bytes + 12);
  for (size_t i = 0; i < 12; ++i) camera->params[i] = get_double(bytes + 16 + 8 * i);
}

static int get_rigid(const uint8_t *bytes, sphc_rigid *rigid) {
  for (size_t i = 0; i < 4; ++i) rigid->q_wxyz[i] = get_double(bytes + 8 * i);
  for (size_t i = 0; i < 3; ++i) rigid->t_m[i] = get_double(bytes + 32 + 8 * i);
  return is_rigid(rigid);
}

static sphc_status get_rig(const uint8_t *header, sphc_raw *raw, sphc_message *message) {
  raw->color_format = (sphc_format)get32(header + 16);
  get_camera(header + 24, &raw->rig.color_camera);
  get_camera(header + 24 + kCameraBytes, &raw->rig.depth_camera);
  get_rigid(header + 248, &raw->rig.color_from_depth);
  raw->rig.depth_unit_m = get_double(header + 304);
  if (!is_color_format(raw->color_format))
    return refuse(message, SPHC_E_ARGUMENT, "raw recording: colour format is not known; convert it again");
  return sphc_rig_check(&raw->rig, message);
}

sphc_status sphc_raw_open(sphc_raw *raw, sphc_raw_read read, void *user, uint64_t file_bytes,
                          sphc_message *message) {
  uint8_t header[kHeaderBytes];
  if (!raw || !read) return refuse(message, SPHC_E_ARGUMENT, "raw or read is null; give both");
  memset(raw, 0, sizeof *raw);
  if (file_bytes < kHeaderBytes)
    return refuse(message, SPHC_E_ARGUMENT, "no raw recording: shorter than its header; copy the file again");
  if (read(user, 0, header, kHeaderBytes) != 0)
    return refuse(message, SPHC_E_DEVICE, "raw recording: the header cannot be read; check the storage");
  if (memcmp(header, "SPHC-RAW", 8) != 0)
    return refuse(message, SPHC_E_ARGUMENT,
                  "no raw recording; make one with: spherecloud convert IN OUT.raw --to raw");
  if (get32(header + 8) != kVersion)
    return refuse(message, SPHC_E_ARGUMENT,
                  "raw recording: not of version 1, which this reader knows; convert it again");
  if (get32(header + 20) != 0 || get32(header + 312) != 0 ||
      crc32_of(0, header, kHeaderBytes - 4) != get32(header + kHeaderBytes - 4))
    return refuse(message, SPHC_E_ARGUMENT,
                  "raw recording: the header has changed (checksum); copy the file again");
  const sphc_status status = get_rig(header, raw, message);
  if (status != SPHC_OK) return status;
  raw->frame_bytes = frame_bytes_of(&raw->rig, raw->color_format);
  const uint32_t frame_count = get32(header + 12);
  if (file_bytes != place_of(frame_count, raw->frame_bytes))
    return refuse(
        message, SPHC_E_ARGUMENT,
        "raw recording: not as long as its frames: it was cut, or never finished; copy the file again, or "
        "leave out what comes after the last frame that it counts");
  raw->read = read;
  raw->user = user;
  raw->frame_count = frame_count; /* not before: a recording that did not open has no frames */
  return SPHC_OK;
}

/* ---- frames ---- */

static sphc_status get_head(const uint8_t *head, sphc_raw_frame *recorded, sphc_message *message) {
  if (crc32_of(0, head, kHeadBytes - 4) != get32(head + kHeadBytes - 4))
    return refuse(message, SPHC_E_DEVICE,
                  "raw recording: a frame's head has changed (checksum); copy the file again");
  sphc_raw_frame told;
  memset(&told, 0, sizeof told);
  told.frame.struct_size = sizeof told.frame;
  told.frame.sequence = get32(head);
  told.has_pose = get32(head + 4);
  told.frame.color_time_ns = (int64_t)get64(head + 8);
  told.frame.depth_time_ns = (int64_t)get64(head + 16);
  if (told.has_pose > 1 || (told.has_pose && !get_rigid(head + 24, &told.world_from_camera)))
    return refuse(message, SPHC_E_DEVICE, "raw recording: a frame's pose is none; convert it again");
  *recorded = told;
  return SPHC_OK;
}

sphc_status sphc_raw_read_head(const sphc_raw *raw, uint32_t index, sphc_raw_frame *recorded,
                               sphc_message *message) {
  uint8_t head[kHeadBytes];
  if (!raw || !recorded || index >= raw->frame_count)
    return refuse(message, SPHC_E_ARGUMENT,
                  "raw or recorded is null, or there is no such frame; give an index below frame_count");
  if (raw->read(raw->user, place_of(index, raw->frame_bytes), head, kHeadBytes) != 0)
    return refuse(message, SPHC_E_DEVICE, "raw recording: a frame cannot be read; check the storage");
  return get_head(head, recorded, message);
}

sphc_status sphc_raw_read_frame(const sphc_raw *raw, uint32_t index, void *memory, size_t memory_bytes,
                                sphc_raw_frame *recorded, sphc_message *message) {
  uint8_t *const bytes = memory;
  if (!raw || !recorded || index >= raw->frame_count)
    return refuse(message, SPHC_E_ARGUMENT,
                  "raw or recorded is null, or there is no such frame; give an index below frame_count");
  if (!memory || (uintptr_t)memory % 2 != 0 || memory_bytes < raw->frame_bytes)
    return refuse(message, SPHC_E_ARGUMENT,
                  "memory is null, odd or too small; give raw->frame_bytes, aligned to 2");
  if (raw->read(raw->user, place_of(index, raw->frame_bytes), bytes, raw->frame_bytes) != 0)
    return refuse(message, SPHC_E_DEVICE, "raw recording: a frame cannot be read; check the storage");
  sphc_raw_frame told; /* what is refused leaves *recorded as it was */
  const sphc_status status = get_head(bytes, &told, message);
  if (status != SPHC_OK) return status;
  if (crc32_of(0, bytes + kHeadBytes, raw->frame_bytes - kHeadBytes) != get32(bytes + kHeadBytes - 8))
    return refuse(message, SPHC_E_DEVICE, "raw recording: an image has changed (checksum); copy the file again");
  const sphc_camera *d = &raw->rig.depth_camera, *c = &raw->rig.color_camera;
  uint8_t *const depth = bytes + kHeadBytes, *const color = depth + image_bytes(d, SPHC_FORMAT_DEPTH16);
  for (uint8_t *at = depth; at < color; at += 2) { /* where the processor is big-endian this swaps */
    const uint16_t value = (uint16_t)(at[0] | at[1] << 8);
    memcpy(at, &value, 2);
  }
  const sphc_image depth_image = {depth, d->width, d->height, 2 * d->width, SPHC_FORMAT_DEPTH16};
  const sphc_image color_image = {color, c->width, c->height, c->width * sphc_format_bytes(raw->color_format),
                                  raw->color_format};
  told.frame.depth = depth_image;
  told.frame.color = color_image;
  *recorded = told;
  return SPHC_OK;
}
