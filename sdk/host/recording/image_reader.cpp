#include "image_reader.h"

#include <algorithm>

#include "encoded_image.h"
#include "failure.h"
#include "file_reader.h"

namespace sphc::recording {

ImageReader::ImageReader(const Recording &recording, const sphc_rig &calibration, sphc_format color_format)
    : recording_(recording),
      color_camera_(calibration.color_camera),
      depth_camera_(calibration.depth_camera),
      color_format_(color_format) {
  if (recording.layout == Layout::kMcap) messages_.emplace(recording.path);
  if (recording.layout == Layout::kRaw) raw_.emplace(recording.path);
  if (recording.images) images_ = recording.images();
}

const sphc_camera &ImageReader::cameraOf(sphc_stream stream) const {
  return stream == SPHC_STREAM_COLOR ? color_camera_ : depth_camera_;
}

sphc_format ImageReader::formatOf(sphc_stream stream) const {
  return stream == SPHC_STREAM_COLOR ? color_format_ : SPHC_FORMAT_DEPTH16;
}

size_t ImageReader::bytesOf(sphc_stream stream) const {
  const sphc_camera &camera = cameraOf(stream);
  return size_t{camera.width} * camera.height * sphc_format_bytes(formatOf(stream));
}

std::string ImageReader::nameOf(sphc_stream stream, const RecordedImage &image) const {
  return shortPath(image.file.empty() ? recording_.path.string() : image.file) + " (" +
         (stream == SPHC_STREAM_COLOR ? "colour " : "depth ") + std::to_string(image.sequence) + ")";
}

ByteView ImageReader::load(const RecordedImage &image) {
  constexpr size_t kMostBytes = size_t{1} << 30;
  readFile(recording_.path / image.file, kMostBytes, encoded_);
  if (encoded_.empty()) throw Failure(SPHC_E_DEVICE, "is empty; remove the frame or copy the file again");
  return viewOf(encoded_);
}

ByteView ImageReader::loadMessage(const MessagePlace &place) {
  const ChunkPlace &chunk = recording_.chunks[place.chunk];
  const uint8_t *bytes = messages_->chunks.load(chunk);
  if (!bytes)
    throw Failure(SPHC_E_DEVICE, "its chunk, at byte " + std::to_string(chunk.start) +
                                     ", does not have the bytes that were written (checksum); copy the file again");
  return {bytes + (place.start - chunk.start), static_cast<size_t>(place.bytes)};
}

void ImageReader::readRaw(sphc_stream stream, uint32_t index, uint8_t *pixels) {
  const sphc_localizer_frame &frame = raw_->load(index);
  const sphc_image &image = stream == SPHC_STREAM_COLOR ? frame.color : frame.depth;
  requireSize(image.width, image.height, cameraOf(stream), stream == SPHC_STREAM_COLOR);
  packPixels(image, formatOf(stream), pixels);
}

sphc_image ImageReader::readAmplitude(const RecordedImage &depth, uint8_t *pixels) {
  if (depth.amplitude.kind == Kind::kNone) return {};
  const sphc_camera &camera = depth_camera_;
  try {
    if (images_)
      images_->readAmplitude(depth, camera, reinterpret_cast<uint16_t *>(pixels));
    else
      messages_->decoder.decode(depth.amplitude.kind, loadMessage(depth.amplitude), camera, SPHC_FORMAT_GRAY16,
                                pixels);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), nameOf(SPHC_STREAM_DEPTH, depth) + ", its amplitudes: " + failure.what());
  }
  return {pixels, camera.width, camera.height, camera.width * 2, SPHC_FORMAT_GRAY16};
}

sphc_image ImageReader::read(sphc_stream stream, const RecordedImage &image, uint8_t *pixels) {
  const sphc_camera &camera = cameraOf(stream);
  const sphc_format format = formatOf(stream);
  try {
    if (messages_)
      messages_->decoder.decode(image.place.kind, loadMessage(image.place), camera, format, pixels);
    else if (raw_)
      readRaw(stream, static_cast<uint32_t>(image.place.start), pixels);
    else if (images_)
      images_->read(stream, image, camera, format, pixels);
    else
      decodeImage(load(image), imageTypeOf(image.file), camera, format, pixels);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), nameOf(stream, image) + ": " + failure.what());
  }
  if (stream == SPHC_STREAM_DEPTH && recording_.layout == Layout::kSevenScenes) {  // where 65535 is a hole
    uint16_t *depth = reinterpret_cast<uint16_t *>(pixels);
    std::replace(depth, depth + size_t{camera.width} * camera.height, uint16_t{65535}, uint16_t{0});
  }
  return {pixels, camera.width, camera.height, camera.width * sphc_format_bytes(format), format};
}

}  // namespace sphc::recording
