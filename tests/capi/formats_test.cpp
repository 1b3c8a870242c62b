// One frame in every format that a camera may have.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "runtime/base/random.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::Session;
using Bytes = std::vector<uint8_t>;

void addWord(uint32_t value, Bytes *bytes) {
  bytes->push_back(static_cast<uint8_t>(value & 255));
  bytes->push_back(static_cast<uint8_t>(value >> 8));
}

// Luma as each format has it; what is not luma is noise that must not be read.
struct Encoding {
  sphc_format format;
  std::function<void(const uint8_t *gray, Bytes *bytes)> encode;  // of a group
  uint32_t group_pixels = 1;
};

const Encoding kEncodings[] = {
    {SPHC_FORMAT_NV12, [](const uint8_t *g, Bytes *to) { to->push_back(*g); }},
    {SPHC_FORMAT_I420, [](const uint8_t *g, Bytes *to) { to->push_back(*g); }},
    {SPHC_FORMAT_RGB8, [](const uint8_t *g, Bytes *to) { to->insert(to->end(), 3, *g); }},
    {SPHC_FORMAT_BGR8, [](const uint8_t *g, Bytes *to) { to->insert(to->end(), 3, *g); }},
    {SPHC_FORMAT_RGBA8,
     [](const uint8_t *g, Bytes *to) {
       to->insert(to->end(), {*g, *g, *g, static_cast<uint8_t>(to->size())});
     }},
    {SPHC_FORMAT_BGRA8,
     [](const uint8_t *g, Bytes *to) {
       to->insert(to->end(), {*g, *g, *g, static_cast<uint8_t>(to->size())});
     }},
    {SPHC_FORMAT_YUYV,
     [](const uint8_t *g, Bytes *to) {
       to->insert(to->end(), {*g, static_cast<uint8_t>(to->size())});
     }},
    {SPHC_FORMAT_UYVY,
     [](const uint8_t *g, Bytes *to) {
       to->insert(to->end(), {static_cast<uint8_t>(to->size()), *g});
     }},
    {SPHC_FORMAT_GRAY10, [](const uint8_t *g, Bytes *to) { addWord(*g << 2 | 1, to); }},
    {SPHC_FORMAT_GRAY12, [](const uint8_t *g, Bytes *to) { addWord(*g << 4 | 9, to); }},
    {SPHC_FORMAT_GRAY16, [](const uint8_t *g, Bytes *to) { addWord(*g << 8 | 77, to); }},
    {SPHC_FORMAT_GRAY10P,
     [](const uint8_t *g, Bytes *to) {
       to->insert(to->end(), {g[0], g[1], g[2], g[3], 0x39});
     },
     4},
    {SPHC_FORMAT_GRAY12P,
     [](const uint8_t *g, Bytes *to) {
       to->insert(to->end(), {g[0], g[1], 0xA7});
     },
     2},
};

class CInterfaceFormats : public testing::Test {
 protected:
  void reencode(const Encoding &encoding, Bytes *bytes) {
    const sphc_camera &camera = config_.rig.color_camera;
    for (size_t i = 0; i < made_->images.gray.size(); i += encoding.group_pixels)
      encoding.encode(&made_->images.gray[i], bytes);
    made_->frame.color = {bytes->data(), camera.width, camera.height,
                          sphc_format_row_bytes(encoding.format, camera.width), encoding.format};
  }
  // The frame's depth in metres, times what `scale` says for a pixel.
  std::vector<float> metres(const std::function<double(uint32_t x, uint32_t y)> &scale) const {
    std::vector<float> depth;
    const sphc_camera &camera = config_.rig.depth_camera;
    for (uint32_t y = 0; y < camera.height; ++y)
      for (uint32_t x = 0; x < camera.width; ++x)
        depth.push_back(static_cast<float>(0.001 * made_->images.depth_mm[y * camera.width + x] * scale(x, y)));
    return depth;
  }
  // Of a pixel of the depth camera: a range is so many times the depth.
  double rangeOverDepth(uint32_t x, uint32_t y) const {
    const double *p = config_.rig.depth_camera.params;
    return std::sqrt(1 + std::pow((x + 0.5 - p[2]) / p[0], 2) + std::pow((y + 0.5 - p[3]) / p[1], 2));
  }
  void setDepth(const void *data, sphc_format format) {
    const sphc_camera &camera = config_.rig.depth_camera;
    made_->frame.depth = {data, camera.width, camera.height, sphc_format_row_bytes(format, camera.width), format};
    config_.depth_format = format;
  }
  sphc_localizer_result localize(sphc_status expected = SPHC_OK) {
    Session session(config_);
    sphc_localizer_result result;
    std::memset(&result, 0, sizeof result);
    EXPECT_EQ(session.process(made_->frame, &result), expected) << sphc_localizer_message(session.localizer());
    error_m_ = expected == SPHC_OK ? session.errorM(result, kViewpoint) : 0;
    message_ = sphc_localizer_message(session.localizer());
    return result;
  }
  sphc_localizer_result expectSame(const sphc_localizer_result &expected, const char *what) {
    const sphc_localizer_result result = localize();
    EXPECT_EQ(std::memcmp(&result, &expected, sizeof result), 0) << what;
    return result;
  }

  static constexpr uint32_t kViewpoint = 1;
  sphc_localizer_config config_ = sphc::test::sceneConfig();
  std::unique_ptr<sphc::test::SceneFrame> made_ = sphc::test::sceneFrame(config_, kViewpoint);
  double error_m_ = 0;
  std::string message_;
};

// The farthest that 16 bits of the unit hold is not what lies beyond it.
TEST_F(CInterfaceFormats, MetresBeyondTheLargestRangeAreNoMeasurement) {
  config_.rig.depth_camera = config_.rig.color_camera;
  config_.rig.color_from_depth = {{1, 0, 0, 0}, {0, 0, 0}};
  config_.rig.depth_unit_m = 1.0 / 8192;
  config_.depth_max_m = 65535 * config_.rig.depth_unit_m;
  made_ = sphc::test::sceneFrame(config_, kViewpoint);
  const std::vector<float> inside(made_->images.gray.size(), 7.9f), beyond(made_->images.gray.size(), 1000.0f);
  setDepth(inside.data(), SPHC_FORMAT_DEPTH_F32);
  EXPECT_GT(localize(SPHC_NOT_LOCALIZED).lifted, 100u);
  setDepth(beyond.data(), SPHC_FORMAT_DEPTH_F32);
  const sphc_localizer_result result = localize(SPHC_NOT_LOCALIZED);
  EXPECT_EQ(result.lifted, 0u);
  EXPECT_TRUE(result.faults & SPHC_FAULT_DEPTH_RANGE);
}

TEST_F(CInterfaceFormats, TheSameLumaGivesTheSameBytes) {
  const sphc_localizer_result expected = localize();
  for (const Encoding &encoding : kEncodings) {
    Bytes bytes;
    reencode(encoding, &bytes);
    expectSame(expected, sphc_format_name(encoding.format));
  }
}

TEST_F(CInterfaceFormats, AFilterIsReadByItsGreen) {
  const Bytes gray = made_->images.gray;
  const sphc_camera &camera = config_.rig.color_camera;
  const bool green_first[4] = {false, true, true, false};
  for (sphc_format format = SPHC_FORMAT_BAYER_RGGB8; format <= SPHC_FORMAT_BAYER_BGGR8; ++format) {
    Bytes raw = gray;  // red and blue are noise
    sphc::Random random(5);
    for (uint32_t y = 0; y < camera.height; ++y)
      for (uint32_t x = 0; x < camera.width; ++x)
        if (((x + y) % 2 == 0) != green_first[format - SPHC_FORMAT_BAYER_RGGB8])
          raw[y * camera.width + x] = static_cast<uint8_t>(random.below(256));
    made_->frame.color = {raw.data(), camera.width, camera.height, camera.width, format};
    localize();
    EXPECT_LT(error_m_, 0.02) << sphc_format_name(format);
    made_->frame.color.format = format ^ 1;  // names the wrong pixels
    localize(SPHC_NOT_LOCALIZED);
  }
}

TEST_F(CInterfaceFormats, TheSameDepthGivesTheSameBytes) {
  const sphc_localizer_result expected = localize();
  const std::vector<float> depth_m = metres([](uint32_t, uint32_t) { return 1.0; });
  setDepth(depth_m.data(), SPHC_FORMAT_DEPTH_F32);
  expectSame(expected, "metres");
  Bytes packed;
  const auto &mm = made_->images.depth_mm;
  for (size_t i = 0; i < mm.size(); i += 2) {
    ASSERT_LT(mm[i], 4096);
    packed.push_back(static_cast<uint8_t>(mm[i] >> 4));
    packed.push_back(static_cast<uint8_t>(mm[i + 1] >> 4));
    packed.push_back(static_cast<uint8_t>((mm[i + 1] & 15) << 4 | (mm[i] & 15)));
  }
  setDepth(packed.data(), SPHC_FORMAT_DEPTH12P);
  expectSame(expected, "12 bits");
}

TEST_F(CInterfaceFormats, ASensorThatIsStuckIsNamedInEachFormat) {
  const size_t pixels = made_->images.depth_mm.size();
  const std::vector<uint16_t> mm(pixels, 2000);
  const std::vector<float> m(pixels, 2);
  for (const sphc_format format :
       {SPHC_FORMAT_DEPTH16, SPHC_FORMAT_RANGE16, SPHC_FORMAT_DEPTH_F32, SPHC_FORMAT_RANGE_F32}) {
    const bool is_float = format == SPHC_FORMAT_DEPTH_F32 || format == SPHC_FORMAT_RANGE_F32;
    setDepth(is_float ? static_cast<const void *>(m.data()) : mm.data(), format);
    EXPECT_TRUE(localize(SPHC_NOT_LOCALIZED).faults & SPHC_FAULT_DEPTH_CONSTANT) << sphc_format_name(format);
  }
}

TEST_F(CInterfaceFormats, RangesAreDistancesFromTheCentre) {
  localize();
  const double by_depth_m = error_m_;
  const std::vector<float> range_m = metres([&](uint32_t x, uint32_t y) { return rangeOverDepth(x, y); });
  setDepth(range_m.data(), SPHC_FORMAT_RANGE_F32);
  localize();
  EXPECT_NEAR(error_m_, by_depth_m, 0.002);
  std::vector<uint16_t> range_mm;
  for (const float m : range_m) range_mm.push_back(static_cast<uint16_t>(std::lround(1000 * m)));
  setDepth(range_mm.data(), SPHC_FORMAT_RANGE16);
  localize();
  EXPECT_NEAR(error_m_, by_depth_m, 0.002);
  setDepth(range_mm.data(), SPHC_FORMAT_DEPTH16);  // taken for z, it bends the room
  Session session(config_);
  sphc_localizer_result result = {};
  const sphc_status status = session.process(made_->frame, &result);
  EXPECT_TRUE(status != SPHC_OK || session.errorM(result, kViewpoint) > 0.01) << session.errorM(result, kViewpoint);
}

// Two thirds of the measurements are much too near, as where light came back by another way, and faint.
TEST_F(CInterfaceFormats, FaintMeasurementsAreNotBelieved) {
  auto &mm = made_->images.depth_mm;
  const sphc_camera &camera = config_.rig.depth_camera;
  Bytes amplitude(mm.size(), 100);
  for (size_t i = 0; i < mm.size(); ++i) {
    if (i % camera.width / 8 % 3 == 0) continue;
    mm[i] = static_cast<uint16_t>(mm[i] * 0.93);
    amplitude[i] = 9;
  }
  config_.amplitude_min = 10;
  made_->frame.amplitude = {amplitude.data(), camera.width, camera.height, camera.width, SPHC_FORMAT_GRAY8};
  localize();
  const double masked_m = error_m_;
  EXPECT_LT(masked_m, 0.01);
  std::fill(amplitude.begin(), amplitude.end(), uint8_t{100});  // nothing is faint any more
  Session believing(config_);
  sphc_localizer_result result = {};
  const sphc_status status = believing.process(made_->frame, &result);
  EXPECT_TRUE(status != SPHC_OK || believing.errorM(result, kViewpoint) > 2 * masked_m)
      << believing.errorM(result, kViewpoint) << " and " << masked_m;
}

TEST_F(CInterfaceFormats, AlignersTakeThemToo) {
  const sphc_camera &color = config_.rig.color_camera;
  const auto align = [&](sphc_format format, const void *data) {
    sphc_aligner_config config;
    EXPECT_EQ(sphc_aligner_config_init(&config, sizeof config), SPHC_OK);
    config.rig = config_.rig;
    config.depth_format = format;
    sphc_memory need = {};
    sphc_message message = {};
    EXPECT_EQ(sphc_aligner_memory(&config, &need, &message), SPHC_OK) << message.text;
    sphc::test::GuardedMemory memory(need.state_bytes, need.alignment);
    sphc_aligner *aligner = nullptr;
    EXPECT_EQ(sphc_aligner_init(memory.data(), memory.size(), &config, &aligner, &message), SPHC_OK)
        << message.text;
    std::vector<uint16_t> depth(color.width * color.height);
    sphc_aligned aligned = {};
    aligned.struct_size = sizeof aligned;
    aligned.depth = depth.data();
    aligned.depth_stride_bytes = 2 * color.width;
    setDepth(data, format);
    EXPECT_EQ(sphc_aligner_process(aligner, &made_->frame.depth, &aligned), SPHC_OK)
        << sphc_aligner_message(aligner);
    made_->frame.depth.format = format == SPHC_FORMAT_DEPTH16 ? SPHC_FORMAT_RANGE16 : SPHC_FORMAT_DEPTH16;
    EXPECT_EQ(sphc_aligner_process(aligner, &made_->frame.depth, &aligned), SPHC_E_IMAGE);
    expectMentions(sphc_aligner_message(aligner), "config.depth_format");
    sphc_aligner_fini(&aligner);
    EXPECT_TRUE(memory.guardsIntact());
    return depth;
  };
  const std::vector<float> depth_m = metres([](uint32_t, uint32_t) { return 1.0; });
  const auto expected = align(SPHC_FORMAT_DEPTH16, made_->images.depth_mm.data());
  EXPECT_EQ(align(SPHC_FORMAT_DEPTH_F32, depth_m.data()), expected);
  const std::vector<float> range_m = metres([&](uint32_t x, uint32_t y) { return rangeOverDepth(x, y); });
  const auto of_ranges = align(SPHC_FORMAT_RANGE_F32, range_m.data());
  uint32_t differing = 0;
  for (size_t i = 0; i < expected.size(); ++i) differing += std::abs(expected[i] - of_ranges[i]) > 2;
  EXPECT_LT(differing, expected.size() / 100);
}

TEST_F(CInterfaceFormats, FramesThatDoNotFitAreRefused) {
  const auto refuse = [&](const char *words) {
    localize(SPHC_E_IMAGE);
    expectMentions(message_.c_str(), words);
  };
  const sphc_image color = made_->frame.color, depth = made_->frame.depth;
  made_->frame.color.format = SPHC_FORMAT_RANGE16;
  refuse("color image has format 13");
  made_->frame.color.format = 99;
  refuse("color image has format 99");
  made_->frame.color = color;
  made_->frame.color.format = SPHC_FORMAT_RGBA8;
  refuse("a row has 1280");
  made_->frame.color = color;
  made_->frame.depth.format = SPHC_FORMAT_RANGE16;
  refuse("config.depth_format");
  made_->frame.depth = depth;
  std::vector<float> floats(depth.width * depth.height + 1, 1.0f);
  setDepth(reinterpret_cast<const uint8_t *>(floats.data()) + 2, SPHC_FORMAT_DEPTH_F32);
  refuse("not aligned");
  setDepth(floats.data(), SPHC_FORMAT_DEPTH_F32);
  made_->frame.depth.stride_bytes += 2;
  refuse("multiple of 4");
  setDepth(depth.data, SPHC_FORMAT_DEPTH16);
  made_->frame.amplitude = made_->frame.color;
  localize();  // nothing is believed by it, so it is not looked at
  EXPECT_LT(error_m_, 0.03);
  config_.amplitude_min = 1;
  refuse("amplitude image is 320 x 240");
  made_->frame.amplitude.format = SPHC_FORMAT_RGB8;
  refuse("amplitude image has format 2");
  made_->frame.amplitude = {};
  refuse("amplitude image is missing");
}

TEST_F(CInterfaceFormats, ConfigsThatDoNotFitAreRefused) {
  const auto refuse = [&](const char *words) {
    sphc_memory need = {};
    sphc_message message = {};
    EXPECT_EQ(sphc_localizer_memory(&config_, &need, &message), SPHC_E_ARGUMENT);
    expectMentions(message.text, words);
    config_ = sphc::test::sceneConfig();
  };
  config_.depth_format = SPHC_FORMAT_GRAY16;
  refuse("depth_format is 22");
  config_.depth_format = -1;
  refuse("depth_format is -1");
  config_.depth_format = SPHC_FORMAT_DEPTH12P;
  config_.rig.depth_camera.width = 201;
  refuse("width is 201");
  config_.depth_format = SPHC_FORMAT_RANGE_F32;
  config_.rig.depth_unit_m = 1e-5;
  refuse("raise the unit");
  config_.amplitude_min = 65536;
  refuse("amplitude_min is 65536");
}

// Beside the bounds of a localizer that reads DEPTH16.
TEST_F(CInterfaceFormats, BoundsOfTheirMemoryHold) {
  for (const uint32_t size : {16u, 200u, 1024u, 8192u}) {
    config_.rig.depth_camera = sphc::test::pinhole(size, size, 500);
    sphc_memory plain = {}, need = {};
    config_.depth_format = 0;
    config_.amplitude_min = 0;
    ASSERT_EQ(sphc_localizer_memory(&config_, &plain, nullptr), SPHC_OK);
    config_.depth_format = SPHC_FORMAT_RANGE16;
    config_.amplitude_min = 1;
    ASSERT_EQ(sphc_localizer_memory(&config_, &need, nullptr), SPHC_OK);
    const uint64_t most = SPHC_LOCALIZER_DEPTH_BYTES_MAX(size, size);
    EXPECT_GT(need.state_bytes, plain.state_bytes);
    EXPECT_LE(need.state_bytes - plain.state_bytes, most);
    EXPECT_GT(need.scratch_bytes, plain.scratch_bytes);
    EXPECT_LE(need.scratch_bytes - plain.scratch_bytes, most);
  }
}

}  // namespace
