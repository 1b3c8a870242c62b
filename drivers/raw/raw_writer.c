#include "raw_writer.h"

#include "raw_bytes.h"

enum { kPieceBytes = 512 };

static sphc_status write_failed(sphc_message *message) {
  return refuse(message, SPHC_E_DEVICE, "raw recording: cannot be written; check the storage and the room on it");
}

/* ---- header ---- */

static void put_camera(uint8_t *bytes, const sphc_camera *camera) {
  put32(bytes, (uint32_t)camera->model);
  put32(bytes + 4, camera->width);
  put32(bytes + 8, camera->height);
  put32(bytes + 12, camera->param_count);
  for (size_t i = 0; i < 12; ++i) put_double(bytes + 16 + 8 * i, i < camera->param_count ? camera->params[i] : 0);
}

static void put_rigid(uint8_t *bytes, const sphc_rigid *rigid) {
  for (size_t i = 0; i < 4; ++i) put_double(bytes + 8 * i, rigid->q_wxyz[i]);
  for (size_t i = 0; i < 3; ++i) put_double(bytes + 32 + 8 * i, rigid->t_m[i]);
}

/* The last four of `count` bytes. */
static void put_crc(uint8_t *bytes, size_t count) { put32(bytes + count - 4, crc32_of(0, bytes, count - 4)); }

static sphc_status write_header(const sphc_raw_writer *writer, sphc_message *message) {
  uint8_t header[kHeaderBytes] = {0};
  memcpy(header, "SPHC-RAW", 8);
  put32(header + 8, kVersion);
  put32(header + 12, writer->frame_count);
  put32(header + 16, (uint32_t)writer->color_format);
  put_camera(header + 24, &writer->rig.color_camera);
  put_camera(header + 24 + kCameraBytes, &writer->rig.depth_camera);
  put_rigid(header + 248, &writer->rig.color_from_depth);
  put_double(header + 304, writer->rig.depth_unit_m);
  put_crc(header, kHeaderBytes);
  return writer->write(writer->user, 0, header, kHeaderBytes) == 0 ? SPHC_OK : write_failed(message);
}

sphc_status sphc_raw_writer_begin(sphc_raw_writer *writer, sphc_raw_write write, void *user, const sphc_rig *rig,
                                  sphc_format color_format, sphc_message *message) {
  if (!writer || !write || !rig)
    return refuse(message, SPHC_E_ARGUMENT, "writer, write or rig is null; give all three");
  memset(writer, 0, sizeof *writer);
  if (!is_color_format(color_format))
    return refuse(message, SPHC_E_ARGUMENT, "color_format is not recorded; give GRAY8, RGB8 or BGR8");
  const sphc_status status = sphc_rig_check(rig, message);
  if (status != SPHC_OK) return status;
  writer->write = write;
  writer->user = user;
  writer->rig = *rig;
  writer->color_format = color_format;
  writer->frame_bytes = frame_bytes_of(rig, color_format);
  return write_header(writer, message);
}

sphc_status sphc_raw_writer_finish(sphc_raw_writer *writer, sphc_message *message) {
  if (!writer || !writer->write)
    return refuse(message, SPHC_E_ARGUMENT, "writer is null or was not begun; call sphc_raw_writer_begin");
  return write_header(writer, message);
}

/* ---- images, which are gone through for their checksum and again to be written ---- */

typedef int (*use_bytes)(void *user, const uint8_t *bytes, size_t count); /* 0: go on */

static int add_to_crc(void *user, const uint8_t *bytes, size_t count) {
  uint32_t *crc = user;
  *crc = crc32_of(*crc, bytes, count);
  return 0;
}

typedef struct output {
  const sphc_raw_writer *writer;
  uint64_t offset;
} output;

static int put_out(void *user, const uint8_t *bytes, size_t count) {
  output *out = user;
  const int failed = out->writer->write(out->writer->user, out->offset, bytes, count);
  out->offset += count;
  return failed;
}

static const uint8_t *row_of(const sphc_image *image, uint32_t y) {
  return (const uint8_t *)image->data + (size_t)y * image->stride_bytes;
}

static int go_through_color(const sphc_image *image, use_bytes use, void *user) {
  const size_t row_bytes = (size_t)image->width * sphc_format_bytes(image->format);
  for (uint32_t y = 0; y < image->height; ++y)
    if (use(user, row_of(image, y), row_bytes) != 0) return 1;
  return 0;
}

static int go_through_depth(const sphc_image *image, use_bytes use, void *user) {
  uint8_t piece[kPieceBytes];
  size_t filled = 0;
  for (uint32_t y = 0; y < image->height; ++y) {
    for (uint32_t x = 0; x < image->width; ++x) {
      uint16_t value;
      memcpy(&value, row_of(image, y) + (size_t)2 * x, 2);
      piece[filled++] = (uint8_t)value;
      piece[filled++] = (uint8_t)(value >> 8);
      if (filled < kPieceBytes) continue;
      if (use(user, piece, filled) != 0) return 1;
      filled = 0;
    }
  }
  return filled ? use(user, piece, filled) : 0;
}

static int go_through(const sphc_localizer_frame *frame, use_bytes use, void *user) {
  return go_through_depth(&frame->depth, use, user) || go_through_color(&frame->color, use, user);
}

/* ---- frames ---- */

/* Null: it fits. */
static const char *misfit_of(const sphc_image *image, const sphc_camera *camera, sphc_format format) {
  if (!image->data) return "data is null; give the pixels";
  if (image->format != format) return "format is not the recording's; convert the pixels";
  if (image->width != camera->width || image->height != camera->height)
    return "size is not its camera's; give the rig of these images to sphc_raw_writer_begin";
  if (image->stride_bytes < image->width * sphc_format_bytes(format))
    return "stride_bytes is less than a row; give the bytes from row to row";
  return NULL;
}

static sphc_status check_image(const char *field, const sphc_image *image, const sphc_camera *camera,
                               sphc_format format, sphc_message *message) {
  char text[SPHC_MESSAGE_BYTES];
  const char *const misfit = misfit_of(image, camera, format);
  if (!misfit) return SPHC_OK;
  strcpy(text, field);
  strcat(text, misfit);
  return refuse(message, SPHC_E_IMAGE, text);
}

static sphc_status check_times(const sphc_raw_writer *writer, const sphc_localizer_frame *frame,
                               sphc_message *message) {
  if (frame->color_time_ns < 0 || frame->depth_time_ns < 0)
    return refuse(message, SPHC_E_ARGUMENT, "frame has a time below 0; give nanoseconds of a clock that counts up");
  if (writer->frame_count == 0) return SPHC_OK;
  if (frame->color_time_ns <= writer->color_time_ns)
    return refuse(
        message, SPHC_E_ARGUMENT,
        "frame.color_time_ns is not after that of the frame before; begin another recording where a clock "
        "starts anew");
  if (frame->depth_time_ns < writer->depth_time_ns)
    return refuse(message, SPHC_E_ARGUMENT,
                  "frame.depth_time_ns is before that of the frame before; begin another recording where a clock "
                  "starts anew");
  return SPHC_OK;
}

static sphc_status check_frame(const sphc_raw_writer *writer, const sphc_localizer_frame *frame,
                               const sphc_rigid *world_from_camera, sphc_message *message) {
  if (!writer || !writer->write || !frame)
    return refuse(message, SPHC_E_ARGUMENT,
                  "writer or frame is null, or the writer was not begun; call sphc_raw_writer_begin");
  if (frame->struct_size != sizeof *frame)
    return refuse(message, SPHC_E_STRUCT_SIZE, "frame.struct_size is not that of this library; set it by sizeof");
  if (writer->frame_count == UINT32_MAX)
    return refuse(message, SPHC_E_STATE, "a recording holds no more frames; begin another one");
  sphc_status status =
      check_image("frame.color: ", &frame->color, &writer->rig.color_camera, writer->color_format, message);
  if (status == SPHC_OK)
    status = check_image("frame.depth: ", &frame->depth, &writer->rig.depth_camera, SPHC_FORMAT_DEPTH16, message);
  if (status == SPHC_OK) status = check_times(writer, frame, message);
  if (status == SPHC_OK && world_from_camera && !is_rigid(world_from_camera))
    return refuse(message, SPHC_E_ARGUMENT,
                  "world_from_camera is not a pose; give a quaternion of unit length and metres, or null");
  return status;
}

static void put_head(uint8_t *head, const sphc_localizer_frame *frame, const sphc_rigid *world_from_camera) {
  uint32_t crc = 0;
  (void)go_through(frame, add_to_crc, &crc);
  put32(head, frame->sequence);
  put32(head + 4, world_from_camera != NULL);
  put64(head + 8, (uint64_t)frame->color_time_ns);
  put64(head + 16, (uint64_t)frame->depth_time_ns);
  if (world_from_camera) put_rigid(head + 24, world_from_camera);
  put32(head + 80, crc);
  put_crc(head, kHeadBytes);
}

sphc_status sphc_raw_writer_add(sphc_raw_writer *writer, const sphc_localizer_frame *frame,
                                const sphc_rigid *world_from_camera, sphc_message *message) {
  uint8_t head[kHeadBytes] = {0};
  const sphc_status status = check_frame(writer, frame, world_from_camera, message);
  if (status != SPHC_OK) return status;
  put_head(head, frame, world_from_camera);
  output out = {writer, place_of(writer->frame_count, writer->frame_bytes)};
  if (put_out(&out, head, kHeadBytes) != 0 || go_through(frame, put_out, &out) != 0) return write_failed(message);
  ++writer->frame_count;
  writer->color_time_ns = frame->color_time_ns;
  writer->depth_time_ns = frame->depth_time_ns;
  return SPHC_OK;
}
