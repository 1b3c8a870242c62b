// .oni recordings as a source.
#include <gmock/gmock.h>

#include <chrono>

#include "oni_file.h"
#include "open_camera.h"
#include "tests/support/temp_folder.h"

namespace sphc::contract {

namespace {

using ::testing::HasSubstr;

constexpr int64_t kPeriodNs = int64_t{1000} * vtof::kPeriodUs;

// A capture, and which of the emitted frames it is by its pixels.
struct Played {
  sphc_capture capture;
  int index;
};

class OniRecording : public VirtualCameras {
 protected:
  std::string record(bool color_begins_late = false) {
    const std::string path = folder_ / "made.oni";
    last_index_ = writeOniFile(path, color_begins_late);
    EXPECT_GT(last_index_, 0);
    return path;
  }

  // Everything until SPHC_END; every byte is checked.
  static std::vector<Played> playAll(const OpenCamera &camera) {
    std::vector<Played> all;
    sphc_capture capture = {};
    sphc_status status;
    while ((status = camera.acquire(&capture)) == SPHC_OK) {
      const int index = vtof::indexOf(*static_cast<const uint8_t *>(capture.image.data));
      EXPECT_EQ(wrongBytes(capture, index), 0u) << "of frame " << index;
      all.push_back({capture, index});
      camera.release(capture);
    }
    EXPECT_EQ(status, SPHC_END) << camera.message();
    return all;
  }
  static std::vector<Played> ofStream(const std::vector<Played> &all, sphc_stream stream) {
    std::vector<Played> some;
    for (const Played &played : all)
      if (played.capture.stream == stream) some.push_back(played);
    return some;
  }
  static uint32_t wrongBytes(const sphc_capture &capture, int index) {
    const OniSensorType sensor = capture.stream == SPHC_STREAM_COLOR ? ONI_SENSOR_COLOR : ONI_SENSOR_DEPTH;
    const uint8_t *bytes = static_cast<const uint8_t *>(capture.image.data);
    uint32_t wrong = 0;
    for (size_t i = 0; i < size_t{capture.image.stride_bytes} * capture.image.height; ++i)
      wrong += bytes[i] != vtof::pattern(sensor, index, i);
    return wrong;
  }
  // From some early frame on every one to the last, numbered from 1.
  void expectWhole(const std::vector<Played> &stream) const {
    ASSERT_GE(stream.size(), size_t{kPairsAtLeast});
    EXPECT_EQ(stream.back().index, last_index_);
    for (size_t i = 0; i < stream.size(); ++i) {
      EXPECT_EQ(stream[i].index, stream[0].index + static_cast<int>(i));
      EXPECT_EQ(stream[i].capture.sequence, i + 1);
      EXPECT_EQ(stream[i].capture.time_ns - stream[0].capture.time_ns, kPeriodNs * static_cast<int64_t>(i));
    }
  }

  test::TempFolder folder_;
  int last_index_ = 0;
};

TEST_F(OniRecording, GivesEveryFrameInOrderAndEnds) {
  const std::string path = record();
  const OpenCamera camera(cameraConfig(), path.c_str());
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  EXPECT_EQ(camera.info().is_recording, 1u);
  size_t count = 0;
  for (int run = 0; run < 2; ++run) {  // the second time the file is opened again
    ASSERT_EQ(camera.start(), SPHC_OK) << camera.message();
    const std::vector<Played> all = playAll(camera);
    expectWhole(ofStream(all, SPHC_STREAM_COLOR));
    expectWhole(ofStream(all, SPHC_STREAM_DEPTH));
    int64_t last_ns = INT64_MIN;
    for (const Played &played : all) {
      EXPECT_GE(played.capture.time_ns, last_ns);
      last_ns = played.capture.time_ns;
      EXPECT_EQ(played.capture.time_sigma_us, 33333u) << "what the file does not know";
      EXPECT_EQ(played.capture.arrival_ns, 0);
    }
    if (run > 0) {
      EXPECT_EQ(all.size(), count);
    }
    count = all.size();
    sphc_capture none = {};
    EXPECT_EQ(camera.acquire(&none), SPHC_END) << "for ever";
    const sphc_openni2_statistics statistics = camera.statistics();
    EXPECT_EQ(statistics.color.captured + statistics.depth.captured, count);
    EXPECT_EQ(statistics.color.lost + statistics.depth.lost, 0u);
    camera.stop();
  }
}

TEST_F(OniRecording, TellsFromTheOrderInTheFileWhichStreamBeganLater) {
  const std::string path = record(true);  // depth runs for a while alone; the file lets both begin at 0
  const OpenCamera camera(cameraConfig(), path.c_str());
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.message();
  const std::vector<Played> all = playAll(camera);
  const std::vector<Played> color = ofStream(all, SPHC_STREAM_COLOR), depth = ofStream(all, SPHC_STREAM_DEPTH);
  ASSERT_LT(depth.front().index + 1, color.front().index);
  expectWhole(color);
  expectWhole(depth);
  for (const Played &c : color)
    for (const Played &d : depth)
      if (c.index == d.index) {
        EXPECT_LE(std::abs(c.capture.time_ns - d.capture.time_ns), kPeriodNs) << "pair " << c.index;
      }
}

TEST_F(OniRecording, LosesNothingToASlowConsumer) {
  const std::string path = record();
  sphc_openni2_config config = cameraConfig();
  config.loan_limit = 2;
  const OpenCamera camera(config, path.c_str());
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.openMessage();
  sphc_capture held = {};
  ASSERT_EQ(camera.acquire(&held), SPHC_OK);
  while (camera.next() == SPHC_OK) continue;
  const sphc_openni2_statistics statistics = camera.statistics();
  EXPECT_GT(statistics.color.captured, uint64_t{kPairsAtLeast} - 1);
  EXPECT_EQ(statistics.color.lost + statistics.color.overrun, 0u);
  EXPECT_EQ(statistics.depth.lost + statistics.depth.overrun, 0u);
}

// The shortest wait counts: a busy machine makes some of them longer, not all.
TEST_F(OniRecording, WaitsNoLongerThanTold) {
  using Clock = std::chrono::steady_clock;
  const std::string path = record();
  for (const uint32_t timeout_us : {0u, kSoonUs}) {
    const OpenCamera camera(cameraConfig(), path.c_str());
    ASSERT_EQ(camera.start(), SPHC_OK) << camera.openMessage();
    uint32_t count = 0;
    Clock::duration shortest = Clock::duration::max();
    sphc_status status = SPHC_AGAIN;
    while (status == SPHC_OK || status == SPHC_AGAIN) {
      const Clock::time_point begin = Clock::now();
      status = camera.next(timeout_us);
      if (status == SPHC_AGAIN) shortest = std::min(shortest, Clock::now() - begin);
      count += status == SPHC_OK;
    }
    EXPECT_EQ(status, SPHC_END);
    EXPECT_GT(count, 2u * kPairsAtLeast - 1);
    EXPECT_LT(shortest, std::chrono::microseconds(timeout_us + 5000)) << "or SPHC_AGAIN never came";
  }
}

TEST_F(OniRecording, RefusesWhatOnlyDevicesHave) {
  const std::string path = record();
  sphc_openni2_config config = cameraConfig();
  config.frame_sync = 1;
  EXPECT_THAT(OpenCamera(config, path.c_str()).openMessage(), HasSubstr("a recording has none"));
  config = cameraConfig();
  config.registration = 1;
  EXPECT_EQ(OpenCamera(config, path.c_str()).status(), SPHC_E_UNSUPPORTED);
  config = cameraConfig();
  config.color = {640, 480, 30};
  EXPECT_THAT(OpenCamera(config, path.c_str()).openMessage(), HasSubstr("the device has 320x240@30 RGB888"));
}

TEST_F(OniRecording, RefusesAFileThatIsNone) {
  folder_.write("not.oni", "this is no recording");
  for (const char *name : {"not.oni", "absent.oni"}) {
    const OpenCamera camera(cameraConfig(), (folder_ / name).c_str());
    EXPECT_EQ(camera.status(), SPHC_E_DEVICE) << name;
    EXPECT_THAT(camera.openMessage(), HasSubstr("cannot be opened"));
  }
}

TEST_F(OniRecording, ThatIsCutShortComesToAnEndOrSaysSo) {
  const std::string path = record();
  const uintmax_t whole_bytes = std::filesystem::file_size(path);
  for (const double kept : {0.95, 0.6, 0.2, 0.001}) {
    const std::string cut = folder_ / "cut.oni";
    std::filesystem::copy_file(path, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, static_cast<uintmax_t>(kept * static_cast<double>(whole_bytes)));
    sphc_openni2_config config = cameraConfig();
    config.stall_us = 100000;
    const OpenCamera camera(config, cut.c_str());
    if (camera.status() != SPHC_OK) {
      EXPECT_EQ(camera.status(), SPHC_E_DEVICE) << kept;
      EXPECT_NE(camera.openMessage(), "");
      continue;
    }
    EXPECT_GT(kept, 0.001) << "there can be nothing in it";
    ASSERT_EQ(camera.start(), SPHC_OK);
    sphc_status status = SPHC_OK;
    while (status == SPHC_OK || status == SPHC_AGAIN) status = camera.next(kSoonUs);
    EXPECT_TRUE(status == SPHC_END || status == SPHC_E_DEVICE) << status << " " << camera.message();
  }
}

TEST_F(OniRecording, StartsAgainOnceItsFileIsBack) {
  const std::string path = record(), aside = folder_ / "aside.oni";
  const OpenCamera camera(cameraConfig(), path.c_str());
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.openMessage();
  ASSERT_EQ(camera.next(), SPHC_OK);
  camera.stop();
  std::filesystem::rename(path, aside);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(camera.start(), SPHC_E_DEVICE);
    EXPECT_THAT(camera.message(), HasSubstr("cannot be opened"));
    EXPECT_EQ(camera.next(), SPHC_E_STATE);
  }
  EXPECT_EQ(camera.info().is_recording, 1u);
  int32_t value = 0;
  EXPECT_EQ(sphc_openni2_get_control(camera.get(), SPHC_OPENNI2_EXPOSURE, &value, nullptr), SPHC_E_UNSUPPORTED);
  std::filesystem::rename(aside, path);
  ASSERT_EQ(camera.start(), SPHC_OK) << camera.message();
  EXPECT_EQ(camera.next(), SPHC_OK);
}

TEST_F(OniRecording, IsNotListedAsADevice) {
  const std::string path = record();
  uint32_t count = 0;
  const OpenCamera camera(cameraConfig(), path.c_str());
  ASSERT_EQ(camera.status(), SPHC_OK) << camera.openMessage();
  ASSERT_EQ(sphc_openni2_list(nullptr, 0, &count, nullptr), SPHC_OK);
  EXPECT_EQ(count, 2u);
}

}  // namespace

}  // namespace sphc::contract
