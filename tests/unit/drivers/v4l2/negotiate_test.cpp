#include <gmock/gmock.h>

#include "opened_camera.h"

namespace sphc::v4l2 {
namespace {

using ::testing::HasSubstr;

constexpr uint32_t kYuyv = V4L2_PIX_FMT_YUYV, kMjpg = V4L2_PIX_FMT_MJPEG;

struct Tried {
  sphc_status status;
  std::string text;
  sphc_v4l2_mode mode;
};

Tried tryCamera(test::FakeCamera fake, const sphc_v4l2_config &config) {
  test::FakeKernel kernel;
  kernel.plugIn(0, std::move(fake));
  const OpenedCamera opened(kernel, config);
  EXPECT_EQ(opened.status < 0, opened.message.text[0] != '\0') << "a text with a failure, and only then";
  return {opened.status, opened.message.text, opened.handle ? opened.mode() : sphc_v4l2_mode{}};
}

TEST(Negotiate, TakesWhatWasAskedFor) {
  const Tried tried = tryCamera(test::FakeCamera({{kYuyv, 32, 32, 30}, {kYuyv, kWidth, kHeight, 30}}),
                                configFor(SPHC_STREAM_COLOR));
  ASSERT_EQ(tried.status, SPHC_OK) << tried.text;
  EXPECT_EQ(tried.mode.fourcc, kYuyv);
  EXPECT_EQ(tried.mode.width, kWidth);
  EXPECT_EQ(tried.mode.stride_bytes, 2 * kWidth);
  EXPECT_EQ(tried.mode.period_denominator, 30u);
  EXPECT_EQ(tried.mode.adjusted, 0u);
  EXPECT_STREQ(tried.mode.node, "/dev/video0");
  EXPECT_STREQ(tried.mode.card, "Fake camera");
}

TEST(Negotiate, PrefersWhatIsCheapButOnlyWhenItHasTheSizeAndRate) {
  const test::FakeCamera usual({{kMjpg, kWidth, kHeight, 30}, {kYuyv, kWidth, kHeight, 30}});
  EXPECT_EQ(tryCamera(usual, configFor(SPHC_STREAM_COLOR)).mode.fourcc, kYuyv);
  const test::FakeCamera slow({{kYuyv, kWidth, kHeight, 5}, {kMjpg, kWidth, kHeight, 30}});
  EXPECT_EQ(tryCamera(slow, configFor(SPHC_STREAM_COLOR)).mode.fourcc, kMjpg);
  const test::FakeCamera small({{kYuyv, 32, 32, 30}, {kMjpg, kWidth, kHeight, 30}});
  EXPECT_EQ(tryCamera(small, configFor(SPHC_STREAM_COLOR)).mode.fourcc, kMjpg);
}

TEST(Negotiate, FollowsTheCallersOrder) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.fourccs[0] = V4L2_PIX_FMT_NV12;
  config.fourccs[1] = kMjpg;
  config.fourccs[2] = kYuyv;
  const test::FakeCamera fake({{kYuyv, kWidth, kHeight, 30}, {kMjpg, kWidth, kHeight, 30}});
  EXPECT_EQ(tryCamera(fake, config).mode.fourcc, kMjpg);
}

TEST(Negotiate, FollowsTheCallersOrderAcrossGaps) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.fourccs[1] = kMjpg;
  config.fourccs[3] = kYuyv;
  const test::FakeCamera fake({{kYuyv, kWidth, kHeight, 30}, {kMjpg, kWidth, kHeight, 30}});
  EXPECT_EQ(tryCamera(fake, config).mode.fourcc, kMjpg);
  EXPECT_EQ(tryCamera(colorCamera(), config).mode.fourcc, kYuyv);
  EXPECT_THAT(tryCamera(test::FakeCamera({{V4L2_PIX_FMT_NV12, kWidth, kHeight, 30}}), config).text,
              HasSubstr("but no layout of config.fourccs"));
}

TEST(Negotiate, NoticesASilentlySubstitutedSize) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  const test::FakeCamera fake({{kYuyv, 64, 36, 30}});
  const Tried refused = tryCamera(fake, config);
  EXPECT_EQ(refused.status, SPHC_E_UNSUPPORTED);
  EXPECT_THAT(refused.text, HasSubstr("asked for YUYV 64 x 48 at 30 fps, it takes YUYV 64 x 36"));
  config.allow_adjusting = 1;
  const Tried taken = tryCamera(fake, config);
  ASSERT_EQ(taken.status, SPHC_OK) << taken.text;
  EXPECT_EQ(taken.mode.height, 36u);
  EXPECT_EQ(taken.mode.adjusted, uint32_t{SPHC_V4L2_ADJUSTED_SIZE});
}

TEST(Negotiate, NoticesASilentlySubstitutedRate) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  EXPECT_THAT(tryCamera(test::FakeCamera({{kYuyv, kWidth, kHeight, 60}}), config).text,
              HasSubstr("at 1/60 s a frame"));
  const test::FakeCamera fake({{kYuyv, kWidth, kHeight, 15}});
  EXPECT_THAT(tryCamera(fake, config).text, HasSubstr("at 1/15 s a frame"));
  config.allow_adjusting = 1;
  EXPECT_EQ(tryCamera(fake, config).mode.adjusted, uint32_t{SPHC_V4L2_ADJUSTED_FPS});
  config.allow_adjusting = 0;
  config.fps = 0;
  EXPECT_EQ(tryCamera(fake, config).mode.period_denominator, 15u) << "whatever the device does";
}

TEST(Negotiate, NoticesASilentlySubstitutedLayout) {  // as vivid does with Z16
  test::FakeCamera fake = depthCamera();
  fake.bend_format = [](v4l2_pix_format &pix) { pix.pixelformat = kYuyv; };
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  for (const uint32_t allow : {0u, 1u}) {
    config.allow_adjusting = allow;
    const Tried tried = tryCamera(fake, config);
    EXPECT_EQ(tried.status, SPHC_E_UNSUPPORTED);
    EXPECT_THAT(tried.text, HasSubstr("silently took YUYV instead of Z16"));
  }
  fake.bend_format = [](v4l2_pix_format &pix) { pix.pixelformat = V4L2_PIX_FMT_Y16; };
  EXPECT_EQ(tryCamera(fake, config).mode.adjusted, uint32_t{SPHC_V4L2_ADJUSTED_FOURCC}) << "depth all the same";
}

TEST(Negotiate, GoesBackToTheNearestAfterTheOthersDidNotFitEither) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.allow_adjusting = 1;
  const Tried tried = tryCamera(test::FakeCamera({{kYuyv, 32, 32, 30}, {kMjpg, 128, 64, 30}}), config);
  EXPECT_EQ(tried.mode.fourcc, kYuyv);
  EXPECT_EQ(tried.mode.width, 32u);
}

TEST(Negotiate, SaysWhatThereIsWhenNothingFits) {
  const Tried tried = tryCamera(test::FakeCamera({{kYuyv, kWidth, kHeight, 30}, {kMjpg, kWidth, kHeight, 30}}),
                                configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(tried.status, SPHC_E_UNSUPPORTED);
  EXPECT_THAT(tried.text, HasSubstr("/dev/video0 offers YUYV MJPG, but no depth (Z16, Y16)"));
}

TEST(Negotiate, FindsALayoutBehindManyOthers) {  // vivid and the bridges of boards offer dozens
  std::vector<test::FakeMode> modes;
  for (char letter = '0'; letter < '0' + 60; ++letter)
    modes.push_back({SPHC_V4L2_FOURCC('Q', 'Q', 'Q', letter), kWidth, kHeight, 30});
  modes.push_back({kYuyv, kWidth, kHeight, 30});
  const Tried tried = tryCamera(test::FakeCamera(modes), configFor(SPHC_STREAM_COLOR));
  ASSERT_EQ(tried.status, SPHC_OK) << tried.text;
  EXPECT_EQ(tried.mode.fourcc, kYuyv);
}

TEST(Negotiate, TakesTheRangeOfTheColourSpaceWhereTheDeviceNamesNone) {
  struct Case {
    uint32_t colorspace, quantization, white;
  };
  for (const Case &c : {Case{V4L2_COLORSPACE_JPEG, V4L2_QUANTIZATION_DEFAULT, 255},
                        Case{V4L2_COLORSPACE_JPEG, V4L2_QUANTIZATION_LIM_RANGE, 235},
                        Case{V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_DEFAULT, 235},
                        Case{V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_FULL_RANGE, 255}}) {
    test::FakeCamera fake = colorCamera();
    fake.bend_format = [=](v4l2_pix_format &pix) {
      pix.colorspace = c.colorspace;
      pix.quantization = c.quantization;
    };
    fake.paint = [=](test::FakeFrame &frame) {
      for (uint32_t i = 0; i < frame.bytes_used; ++i)
        frame.data[i] = static_cast<uint8_t>(i % 2 ? 128 : c.white - 20);
    };
    sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
    config.format = SPHC_FORMAT_RGB8;
    RunningCamera running(fake, config);
    const auto *pixel = static_cast<const uint8_t *>(running.opened.take().image.data);
    EXPECT_EQ(pixel[0], c.white == 255 ? 235 : 232) << c.colorspace << ' ' << c.quantization;
  }
}

TEST(Negotiate, RefusesModesThatCannotBe) {
  const std::function<void(v4l2_pix_format &)> lies[] = {
      [](v4l2_pix_format &pix) { pix.width = 0; },
      [](v4l2_pix_format &pix) { pix.height = 100000; },
      [](v4l2_pix_format &pix) { pix.width = 65; },  // pixels in pairs
      [](v4l2_pix_format &pix) { pix.bytesperline = 2 * kWidth - 1; },
      [](v4l2_pix_format &pix) { pix.bytesperline = UINT32_MAX; },
      [](v4l2_pix_format &pix) { pix.sizeimage -= 1; },
      [](v4l2_pix_format &pix) { pix.sizeimage = 0; },
      [](v4l2_pix_format &pix) { pix.sizeimage = UINT32_MAX; },
      [](v4l2_pix_format &pix) { pix.field = V4L2_FIELD_INTERLACED; }};
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.allow_adjusting = 1;
  for (size_t i = 0; i < std::size(lies); ++i) {
    test::FakeCamera fake = colorCamera();
    fake.bend_format = lies[i];
    EXPECT_EQ(tryCamera(fake, config).status, SPHC_E_UNSUPPORTED) << "lie " << i;
  }
}

TEST(Negotiate, TakesAMissingStrideForNone) {
  test::FakeCamera fake = colorCamera();
  fake.bend_format = [](v4l2_pix_format &pix) { pix.bytesperline = 0; };
  EXPECT_EQ(tryCamera(fake, configFor(SPHC_STREAM_COLOR)).mode.stride_bytes, 2 * kWidth);
}

}  // namespace
}  // namespace sphc::v4l2
