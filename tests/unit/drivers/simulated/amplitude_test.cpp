// What a ToF module measures before it drops anything, and what its amplitude tells of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "handle.h"
#include "runtime/stages/align/depth_reader.h"
#include "tests/support/arena_memory.h"

namespace sphc::simulated::test {
namespace {

struct Errors {
  std::vector<double> relative;  // of all that is measured, ascending
  double at(double share) const { return relative[static_cast<size_t>(share * double(relative.size() - 1))]; }
};

class SimulatedAmplitude : public testing::Test {
 protected:
  SimulatedAmplitude() {
    sphc_simulated_config config = defaults();
    config.seed = 5;
    config.raw_depth = 1;
    handle_ = std::make_unique<Handle>(config);
    EXPECT_EQ(sphc_simulated_rig(handle_->get(), &rig_), SPHC_OK);
  }

  // As the localizer reads depth; 0: amplitudes are not asked.
  std::vector<uint16_t> read(const std::vector<uint16_t> &depth, const std::vector<uint16_t> &amplitude,
                             uint32_t least) {
    DepthReaderConfig config = {Camera(rig_.depth_camera), rig_.depth_unit_m, {}, least};
    Arena state_bytes, scratch_bytes;
    DepthReader::layout(config, state_bytes, scratch_bytes, nullptr);
    std::vector<uint8_t> scratch(scratch_bytes.used() + kArenaAlignment);
    Arena state, arena(sphc::test::alignedStart(&scratch));
    DepthReader reader;
    DepthReader::layout(config, state, arena, &reader);
    reader.init(config);
    const auto width = static_cast<int32_t>(rig_.depth_camera.width),
               height = static_cast<int32_t>(rig_.depth_camera.height);
    const auto bytes = [&](const std::vector<uint16_t> &pixels) {
      return ByteView{reinterpret_cast<const uint8_t *>(pixels.data()), width, height, 2 * width};
    };
    const ImageView<uint16_t> z = reader.read(bytes(depth), {bytes(amplitude), 2});
    return {z.data, z.data + size_t(width) * size_t(height)};
  }

  // Of one frame, without the mask and with it.
  void measure(uint32_t index, Errors *raw, Errors *masked) {
    std::vector<uint16_t> depth(kDepthPixels), amplitude(kDepthPixels);
    ASSERT_EQ(sphc_simulated_render_depth(handle_->get(), index, depth.data()), SPHC_OK);
    ASSERT_EQ(sphc_simulated_render_amplitude(handle_->get(), index, amplitude.data()), SPHC_OK);
    int64_t time_ns = 0;
    ASSERT_EQ(sphc_simulated_frame_times(handle_->get(), index, nullptr, &time_ns), SPHC_OK);
    std::vector<float> truth(kDepthPixels);
    ASSERT_EQ(sphc_simulated_oracle_tof_depth(handle_->get(), time_ns, truth.data()), SPHC_OK);
    add(read(depth, amplitude, 0), truth, raw);
    add(read(depth, amplitude, SPHC_SIMULATED_FAINT), truth, masked);
  }
  void add(const std::vector<uint16_t> &z, const std::vector<float> &truth, Errors *errors) {
    for (size_t i = 0; i < z.size(); ++i) {
      if (z[i] == 0) continue;
      const double true_m = static_cast<double>(truth[i]);
      errors->relative.push_back(std::abs(z[i] * rig_.depth_unit_m - true_m) / true_m);
    }
  }

  std::unique_ptr<Handle> handle_;
  sphc_rig rig_ = {};
};

// Of a module that drops nothing; another one has dropped already what they would tell of.
TEST_F(SimulatedAmplitude, GoesWithTheSourcesRawDepth) {
  for (const uint32_t raw : {1u, 0u}) {
    sphc_simulated_config config = defaults();
    config.raw_depth = raw;
    const Handle handle(config);
    sphc_source source{};
    source.struct_size = sizeof source;
    ASSERT_EQ(sphc_simulated_source(handle.get(), &source), SPHC_OK);
    ASSERT_EQ(source.start(source.self), SPHC_OK);
    sphc_capture color{}, depth{};
    color.struct_size = depth.struct_size = sizeof color;
    ASSERT_EQ(source.acquire(source.self, 0, &color), SPHC_OK);
    ASSERT_EQ(source.acquire(source.self, 0, &depth), SPHC_OK);
    EXPECT_EQ(color.amplitude.data, nullptr);
    ASSERT_EQ(depth.stream, SPHC_STREAM_DEPTH);
    ASSERT_EQ(depth.amplitude.data != nullptr, raw == 1);
    std::vector<uint16_t> expected(kDepthPixels);
    ASSERT_EQ(sphc_simulated_render_depth(handle.get(), 0, expected.data()), SPHC_OK);
    EXPECT_EQ(std::memcmp(depth.image.data, expected.data(), 2 * kDepthPixels), 0);
    if (!raw) continue;
    EXPECT_EQ(depth.amplitude.format, SPHC_FORMAT_GRAY16);
    EXPECT_EQ(depth.amplitude.stride_bytes, 2 * SPHC_SIMULATED_DEPTH_WIDTH);
    ASSERT_EQ(sphc_simulated_render_amplitude(handle.get(), 0, expected.data()), SPHC_OK);
    EXPECT_EQ(std::memcmp(depth.amplitude.data, expected.data(), 2 * kDepthPixels), 0);
  }
}

TEST_F(SimulatedAmplitude, TellsWhatNotToBelieve) {
  Errors raw, masked;
  for (const uint32_t index : {3u, 37u, 71u}) measure(index, &raw, &masked);
  for (Errors *errors : {&raw, &masked}) std::sort(errors->relative.begin(), errors->relative.end());
  EXPECT_LT(masked.at(0.99), raw.at(0.99) / 2);
  EXPECT_LT(masked.at(0.999), raw.at(0.999) / 2);
  EXPECT_LT(masked.at(1), raw.at(1) / 2);
  EXPECT_GT(masked.relative.size(), raw.relative.size() * 95 / 100);
  EXPECT_LE(masked.at(0.5), 1.05 * raw.at(0.5));
}

}  // namespace
}  // namespace sphc::simulated::test
