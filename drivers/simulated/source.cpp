#include "drivers/simulated/source.h"

#include <algorithm>
#include <exception>
#include <new>

#include "drivers/simulated/config.h"

namespace sphc::simulated {

namespace {

// A colour image, or depth and its amplitudes.
size_t slotBytes(const sphc_rig &rig) {
  const size_t color_pixels = size_t{rig.color_camera.width} * rig.color_camera.height;
  const size_t depth_pixels = size_t{rig.depth_camera.width} * rig.depth_camera.height;
  return std::max(3 * color_pixels, 2 * sizeof(uint16_t) * depth_pixels);
}

}  // namespace

Source::Source(const Headset &headset) : headset_(headset) {
  for (Slot &slot : slots_) slot.bytes = std::make_unique<uint8_t[]>(slotBytes(headset.rig()));
}

void Source::fill(sphc_source *source) {
  source->loan_limit = kSlots;
  source->self = this;
  source->start = [](void *self) { return static_cast<Source *>(self)->start(); };
  source->acquire = [](void *self, uint32_t, sphc_capture *capture) {
    return static_cast<Source *>(self)->acquire(capture);
  };
  source->release = [](void *self, const sphc_capture *capture) {
    if (capture != nullptr) static_cast<Source *>(self)->release(*capture);
  };
  source->stop = [](void *self) { static_cast<Source *>(self)->stop(); };
  source->message = [](const void *self) -> const char * {
    return static_cast<const Source *>(self)->message_.text;
  };
}

sphc_status Source::fail(sphc_status status, const char *text) {
  explain(&message_, "simulated: %s", text);
  return status;
}

sphc_status Source::start() {
  if (running_) return fail(SPHC_E_STATE, "start while running; stop first");
  running_ = true;
  captures_ = 0;
  return SPHC_OK;
}

void Source::stop() {
  running_ = false;
  for (Slot &slot : slots_) slot.token = 0;
}

void Source::release(const sphc_capture &capture) {
  for (Slot &slot : slots_) {
    // the image tells our captures from another source's with an equal token
    if (slot.token != 0 && slot.token == capture.token && slot.bytes.get() == capture.image.data) slot.token = 0;
  }
}

sphc_status Source::acquire(sphc_capture *capture) {
  if (!running_) return fail(SPHC_E_STATE, "acquire while stopped; start first");
  if (capture == nullptr) return fail(SPHC_E_ARGUMENT, "acquire into null; give a capture");
  if (capture->struct_size != sizeof *capture) {
    return fail(SPHC_E_STRUCT_SIZE, "capture.struct_size is not known; set it to sizeof(sphc_capture)");
  }
  const auto index = static_cast<uint32_t>(captures_ / 2);
  if (index >= headset_.config().frame_count) return SPHC_END;
  Slot *slot = std::find_if(std::begin(slots_), std::end(slots_), [](const Slot &s) { return s.token == 0; });
  if (slot == std::end(slots_)) return fail(SPHC_E_STATE, "all 8 captures are on loan; release one first");
  const bool color_first = headset_.config().depth_delay_ns >= 0;
  const bool color = (captures_ % 2 == 0) == color_first;
  try {
    render(*slot, color ? SPHC_STREAM_COLOR : SPHC_STREAM_DEPTH, index, capture);
  } catch (const std::bad_alloc &) {
    return fail(SPHC_E_MEMORY_SIZE, "out of memory while rendering; free some and acquire again");
  } catch (const std::exception &error) {
    return fail(SPHC_E_INTERNAL, error.what());
  }
  ++captures_;
  return SPHC_OK;
}

void Source::render(Slot &slot, sphc_stream stream, uint32_t index, sphc_capture *capture) {
  sphc_capture out{};
  out.struct_size = sizeof out;
  out.stream = stream;
  out.sequence = index;
  out.image.data = slot.bytes.get();
  const sphc_camera &camera =
      stream == SPHC_STREAM_COLOR ? headset_.rig().color_camera : headset_.rig().depth_camera;
  out.image.width = camera.width;
  out.image.height = camera.height;
  if (stream == SPHC_STREAM_COLOR) {
    headset_.renderColor(index, slot.bytes.get());
    out.time_ns = headset_.colorTime(index);
    out.image.stride_bytes = camera.width * 3;
    out.image.format = SPHC_FORMAT_RGB8;
  } else {
    // Storage from new[] is aligned for any scalar.
    auto *const depth = reinterpret_cast<uint16_t *>(slot.bytes.get());
    headset_.renderDepth(index, depth);
    out.time_ns = headset_.depthTime(index);
    out.image.stride_bytes = camera.width * static_cast<uint32_t>(sizeof(uint16_t));
    out.image.format = SPHC_FORMAT_DEPTH16;
    if (headset_.config().raw_depth != 0) {  // a module that drops nothing tells what is to be dropped
      uint16_t *const amplitude = depth + size_t{camera.width} * camera.height;
      headset_.renderAmplitude(index, amplitude);
      out.amplitude = out.image;
      out.amplitude.data = amplitude;
      out.amplitude.format = SPHC_FORMAT_GRAY16;
    }
  }
  slot.token = out.token = ++last_token_;
  *capture = out;
}

}  // namespace sphc::simulated
