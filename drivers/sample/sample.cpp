// A source in its smallest form.  Copy it, and put the device where the comments say "a real driver".
#include "sample.h"

#include <cstring>
#include <new>

namespace {

constexpr uint32_t kLoanLimit = 5;  // the slots of a pairer and one
constexpr uint32_t kPixels = SPHC_SAMPLE_WIDTH * SPHC_SAMPLE_HEIGHT;
constexpr int64_t kPeriodNs = 33333333;
constexpr int64_t kDepthLagNs = 5000000;  // the depth sensor exposes a little later, as most do
constexpr uint16_t kPlaneMm = 2000;

// One buffer that can be out on loan.
struct Slot {
  uint64_t token;  // of its loan; 0 when free
  alignas(8) uint8_t pixels[kPixels * sizeof(uint16_t)];
};

}  // namespace

struct sphc_sample {
  uint32_t frames;  // 0: endless
  bool running;
  uint32_t next;        // capture to give: 0 colour 0, 1 depth 0, 2 colour 1, ...
  uint64_t last_token;  // counts on through restarts, so that an old loan is never taken for a new one
  int64_t start_ns;     // the clock at start: it is monotonic through restarts
  int64_t now_ns;
  const char *message;  // never null
  Slot slots[kLoanLimit];
};

namespace {

sphc_sample *sampleOf(void *self) { return static_cast<sphc_sample *>(self); }

// Every failure leaves its reason; the text must live until the next call, so static text is the easiest.
sphc_status fail(sphc_sample *sample, sphc_status status, const char *message) {
  sample->message = message;
  return status;
}

void drawGradient(uint32_t frame, uint8_t *pixels) {
  for (uint32_t y = 0; y < SPHC_SAMPLE_HEIGHT; ++y)
    for (uint32_t x = 0; x < SPHC_SAMPLE_WIDTH; ++x)
      pixels[y * SPHC_SAMPLE_WIDTH + x] = static_cast<uint8_t>(4 * x + y + frame);
}

void drawPlane(uint8_t *pixels) {
  for (uint32_t i = 0; i < kPixels; ++i) std::memcpy(pixels + i * sizeof kPlaneMm, &kPlaneMm, sizeof kPlaneMm);
}

void endLoans(sphc_sample *sample) {
  for (Slot &slot : sample->slots) slot.token = 0;
}

Slot *freeSlot(sphc_sample *sample) {
  for (Slot &slot : sample->slots)
    if (slot.token == 0) return &slot;
  return nullptr;
}

// stopped -> running.  A real driver: start the streams here, and undo what was started when a later step fails.
sphc_status start(void *self) {
  if (!self) return SPHC_E_ARGUMENT;
  sphc_sample *sample = sampleOf(self);
  if (sample->running) return fail(sample, SPHC_E_STATE, "start: running already; call stop first");
  sample->next = 0;
  sample->start_ns = sample->now_ns + kPeriodNs;
  sample->running = true;
  return SPHC_OK;
}

// A real driver: wait up to timeout_us for the device, SPHC_AGAIN when nothing came, SPHC_E_DEVICE_LOST when it was
// unplugged; time_ns from the device's clock at mid-exposure; count lost captures in `sequence`.
sphc_status acquire(void *self, uint32_t /*timeout_us*/, sphc_capture *capture) {
  if (!self) return SPHC_E_ARGUMENT;
  sphc_sample *sample = sampleOf(self);
  if (!capture) return fail(sample, SPHC_E_ARGUMENT, "acquire: capture is null; give one");
  if (capture->struct_size != sizeof *capture)
    return fail(sample, SPHC_E_STRUCT_SIZE, "acquire: set capture.struct_size to sizeof(sphc_capture)");
  if (!sample->running) return fail(sample, SPHC_E_STATE, "acquire: not running; call start first");
  const uint32_t frame = sample->next / 2;
  const bool is_depth = sample->next % 2 != 0;
  if (sample->frames != 0 && frame == sample->frames) return SPHC_END;
  Slot *slot = freeSlot(sample);
  if (!slot) return fail(sample, SPHC_E_STATE, "acquire: loan_limit reached; release a capture first");

  is_depth ? drawPlane(slot->pixels) : drawGradient(frame, slot->pixels);
  slot->token = ++sample->last_token;
  sample->next = sample->next + 1;
  sample->now_ns = sample->start_ns + frame * kPeriodNs + (is_depth ? kDepthLagNs : 0);

  // Only now, when nothing can fail any more, the output is written.
  const uint32_t stride = SPHC_SAMPLE_WIDTH * (is_depth ? 2u : 1u);
  *capture = {};
  capture->struct_size = sizeof *capture;
  capture->stream = is_depth ? SPHC_STREAM_DEPTH : SPHC_STREAM_COLOR;
  capture->time_ns = sample->now_ns;
  capture->token = slot->token;
  capture->sequence = frame;
  capture->image = {slot->pixels, SPHC_SAMPLE_WIDTH, SPHC_SAMPLE_HEIGHT, stride,
                    is_depth ? SPHC_FORMAT_DEPTH16 : SPHC_FORMAT_GRAY8};
  return SPHC_OK;
}

// Ignores whatever is not on loan: released already, from before a restart, or another source's.
void release(void *self, const sphc_capture *capture) {
  if (!self || !capture || capture->token == 0) return;
  for (Slot &slot : sampleOf(self)->slots)
    if (slot.token == capture->token && slot.pixels == capture->image.data) slot.token = 0;
}

// running -> stopped.  A real driver: stop the streams; it must also work after SPHC_E_DEVICE_LOST.
void stop(void *self) {
  if (!self) return;
  sampleOf(self)->running = false;
  endLoans(sampleOf(self));
}

const char *message(const void *self) {
  return self ? static_cast<const sphc_sample *>(self)->message : "self is null";
}

}  // namespace

extern "C" {

sphc_status sphc_sample_open(uint32_t frames, sphc_sample **sample, sphc_message *message) {
  if (!sample) return SPHC_E_ARGUMENT;
  sphc_sample *opened = new (std::nothrow) sphc_sample{};
  if (!opened) {
    if (message) std::strncpy(message->text, "out of memory", SPHC_MESSAGE_BYTES);
    return SPHC_E_DEVICE;
  }
  opened->frames = frames;
  opened->message = "";
  *sample = opened;
  return SPHC_OK;
}

void sphc_sample_close(sphc_sample **sample) {
  if (!sample) return;
  delete *sample;
  *sample = nullptr;
}

sphc_status sphc_sample_source(sphc_sample *sample, sphc_source *source) {
  if (!sample || !source) return SPHC_E_ARGUMENT;
  *source = {sizeof *source, kLoanLimit, sample, start, acquire, release, stop, message};
  return SPHC_OK;
}

}  // extern "C"
