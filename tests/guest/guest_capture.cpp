// Runs inside the guest, on cameras that play a recording:
//
//     guest_capture --pair COLOR DEPTH        both streams must be the recording's bytes, and the poses replay's
//     guest_capture --ring SOURCE STREAM      the stream must be the recording's bytes; STREAM: color or depth
//     guest_capture --lost SOURCE STREAM      captures until the camera is unplugged; then it must be lost
//     guest_capture --stall SOURCE STREAM     captures until nothing comes; then there must be nothing yet, and no
//     more
//
// Exits with 0 when that is so.
#include <cstdio>
#include <cstring>
#include <exception>
#include <set>

#include "drivers/pixels/convert.h"
#include "live_source.h"
#include "pose_log.h"

namespace sphc::guest {

namespace {

constexpr const char *kRecorded = "/recorded";
constexpr uint32_t kTimeoutUs = 1000000;
constexpr int kPatience = 60;  // timeouts without a frame: an emulator on a busy machine is slow

[[noreturn]] void fail(const std::string &what) { throw std::runtime_error(what); }

// The recording as the driver should give it.
std::vector<std::vector<uint8_t>> recordedImages(sphc_stream stream) {
  const bool is_depth = stream == SPHC_STREAM_DEPTH;
  const std::vector<uint8_t> raw = readFile(std::string(kRecorded) + (is_depth ? kDepthFile : kColorFile));
  const size_t raw_bytes = raw.size() / kFrames;
  std::vector<std::vector<uint8_t>> images;
  for (uint32_t i = 0; i < kFrames; ++i) {
    const uint8_t *frame = raw.data() + i * raw_bytes;
    if (is_depth) {
      images.emplace_back(frame, frame + raw_bytes);
      continue;
    }
    images.emplace_back(kColorWidth * kColorHeight * 3);
    sphc_message message = {};
    if (pixels::convert(
            pixels::contiguous(pixels::Layout::Yuyv, pixels::YuvRange::Limited, kColorWidth, kColorHeight,
                               kColorWidth * 2, frame, raw_bytes),
            {images[i].data(), images[i].size(), kColorWidth, kColorHeight, kColorWidth * 3, SPHC_FORMAT_BGR8},
            &message) != SPHC_OK)
      fail(message.text);
  }
  return images;
}

sphc_status acquire(const sphc_source &source, sphc_capture *capture) {
  sphc_status status = SPHC_AGAIN;
  for (int i = 0; i < kPatience && status == SPHC_AGAIN; ++i) {
    *capture = {};
    capture->struct_size = sizeof *capture;
    status = source.acquire(source.self, kTimeoutUs, capture);
  }
  return status;
}

std::vector<uint8_t> tightCopy(const sphc_image &image) {
  const uint32_t row_bytes = image.width * (image.format == SPHC_FORMAT_DEPTH16 ? 2 : 3);
  std::vector<uint8_t> copy;
  for (uint32_t y = 0; y < image.height; ++y) {
    const uint8_t *row = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    copy.insert(copy.end(), row, row + row_bytes);
  }
  return copy;
}

uint32_t findImage(const std::vector<uint8_t> &image, const std::vector<std::vector<uint8_t>> &recorded) {
  for (uint32_t i = 0; i < kFrames; ++i)
    if (image == recorded[i]) return i;
  fail("an image that is none of the recording's");
}

// Captures until every frame of the ring came.  Every one must be the recording's, to the bit, and the one that its
// sequence number says, which counts lost ones too.  The first one of all is frame 0 in the kernel's count;
// libcamera begins to count with the first that it gets.
std::vector<std::vector<uint8_t>> captureRing(const std::string &what, sphc_stream stream) {
  const std::vector<std::vector<uint8_t>> recorded = recordedImages(stream);
  const LiveSource live = openLive(what, stream);
  const sphc_source &source = live.source;
  if (source.start(source.self) != SPHC_OK) fail(what + ": " + source.message(source.self));
  std::vector<std::vector<uint8_t>> ring(kFrames);
  std::set<uint32_t> seen;
  int64_t last_ns = INT64_MIN;
  uint32_t count = 0, refused = 0, last_sequence = 0, offset = 0;
  while (seen.size() < kFrames) {
    sphc_capture capture;
    const sphc_status status = acquire(source, &capture);
    if (status == SPHC_E_DEVICE && ++refused == 1) continue;  // one frame may be damaged
    if (status != SPHC_OK) fail(what + ": " + source.message(source.self));
    if (capture.time_ns <= last_ns) fail(what + ": time stands still");
    if (count > 0 && capture.sequence <= last_sequence) fail(what + ": sequence stands still");
    if (capture.clock != SPHC_CLOCK_MONOTONIC) fail(what + ": times of another clock than V4L2's");
    last_ns = capture.time_ns;
    last_sequence = capture.sequence;
    std::vector<uint8_t> image = tightCopy(capture.image);
    const uint32_t index = findImage(image, recorded);
    if (count == 0 && what.rfind("libcamera", 0) == 0) offset = index - capture.sequence;
    if (index != (capture.sequence + offset) % kFrames)
      fail(what + ": frame " + std::to_string(capture.sequence) + " is image " + std::to_string(index));
    ring[index] = std::move(image);
    seen.insert(index);
    ++count;
    source.release(source.self, &capture);
  }
  source.stop(source.self);
  std::printf("%s: %u captures of %u frames, %u refused, identical\n", what.c_str(), count, last_sequence + 1,
              refused);
  return ring;
}

void showDifferences(const sphc_localizer_result *expected, const sphc_localizer_result *here) {
  for (uint32_t i = 0; i < kFrames; ++i) {
    const sphc_localizer_result &a = expected[i], &b = here[i];
    std::printf("frame %u: %s; keypoints %u %u, lifted %u %u, matches %u %u, inliers %u %u; x %.17g %.17g\n", i,
                std::memcmp(&a, &b, sizeof a) == 0 ? "same" : "differs", a.keypoints, b.keypoints, a.lifted,
                b.lifted, a.matches, b.matches, a.inliers, b.inliers, a.camera_from_map.t_m[0],
                b.camera_from_map.t_m[0]);
  }
}

void localize(const std::vector<std::vector<uint8_t>> &color, const std::vector<std::vector<uint8_t>> &depth) {
  const Cameras cameras = readCameras(kRecorded);
  PoseLog log(kRecorded);
  for (uint32_t i = 0; i < kFrames; ++i) {
    sphc_localizer_frame frame{};
    frame.struct_size = sizeof frame;
    frame.sequence = cameras.sequence[i];
    frame.color_time_ns = cameras.color_time_ns[i];
    frame.depth_time_ns = cameras.depth_time_ns[i];
    frame.color = {color[i].data(), kColorWidth, kColorHeight, kColorWidth * 3, SPHC_FORMAT_BGR8};
    frame.depth = {depth[i].data(), kDepthWidth, kDepthHeight, kDepthWidth * 2, SPHC_FORMAT_DEPTH16};
    log.add(frame);
  }
  const std::vector<uint8_t> expected = readFile(std::string(kRecorded) + kPosesFile);
  if (expected.size() != log.bytes()) fail("poses of another build");
  if (std::memcmp(expected.data(), log.data(), log.bytes()) != 0) {
    showDifferences(reinterpret_cast<const sphc_localizer_result *>(expected.data()), log.results());
    fail("poses differ from replay's");
  }
  std::printf("poses: %u of %u localized, %zu bytes, identical to replay's\n", log.localized(), kFrames,
              log.bytes());
}

// Captures until acquire says something else; gives that.
sphc_status captureWhileItLasts(const LiveSource &live, uint32_t timeout_us, uint32_t *count) {
  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  sphc_status status = acquire(live.source, &capture);
  for (*count = 0; status == SPHC_OK; ++*count) {
    live.source.release(live.source.self, &capture);
    status = live.source.acquire(live.source.self, timeout_us, &capture);
  }
  return status;
}

void expectEnd(const std::string &what, sphc_stream stream, sphc_status expected) {
  const LiveSource live = openLive(what, stream);
  if (live.source.start(live.source.self) != SPHC_OK) fail(live.source.message(live.source.self));
  uint32_t count = 0;
  const sphc_status status =
      captureWhileItLasts(live, expected == SPHC_AGAIN ? kTimeoutUs : kPatience * kTimeoutUs, &count);
  std::printf("%s: after %u captures %s: %s\n", what.c_str(), count, sphc_status_name(status),
              live.source.message(live.source.self));
  if (status != expected || count == 0) fail("expected captures, then " + std::string(sphc_status_name(expected)));
  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  if (live.source.acquire(live.source.self, 0, &capture) != expected) fail("and again");
  live.source.stop(live.source.self);
  if (expected == SPHC_E_DEVICE_LOST && live.source.start(live.source.self) == SPHC_OK)
    fail("starts without a camera");
}

int run(int argc, char **argv) {
  if (argc != 4) return 2;
  const std::string what = argv[1];
  const sphc_stream stream = std::strcmp(argv[3], "depth") == 0 ? SPHC_STREAM_DEPTH : SPHC_STREAM_COLOR;
  if (what == "--lost") {
    expectEnd(argv[2], stream, SPHC_E_DEVICE_LOST);
  } else if (what == "--stall") {
    expectEnd(argv[2], stream, SPHC_AGAIN);
  } else if (what == "--ring") {
    captureRing(argv[2], stream);
  } else if (what == "--pair") {
    const auto color = captureRing(argv[2], SPHC_STREAM_COLOR), depth = captureRing(argv[3], SPHC_STREAM_DEPTH);
    localize(color, depth);
  } else {
    return 2;
  }
  return 0;
}

}  // namespace

}  // namespace sphc::guest

int main(int argc, char **argv) try {
  setvbuf(stdout, nullptr, _IOLBF, 0);
  return sphc::guest::run(argc, argv);
} catch (const std::exception &error) {
  std::printf("FAILED: %s\n", error.what());
  return 1;
}
