#include "runtime/stages/align/depth_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "tests/support/arena_memory.h"
#include "tests/support/scene.h"

namespace sphc {
namespace {

constexpr int32_t kReaderWidth = 8, kReaderHeight = 6;

class DepthReaderTest : public testing::Test {
 protected:
  DepthReaderTest() {
    config_.camera = Camera(test::pinhole(kReaderWidth, kReaderHeight, 5));
    for (int32_t i = 0; i < kReaderWidth * kReaderHeight; ++i)
      units_.push_back(static_cast<uint16_t>(1000 + 2 * i));
  }

  // Anew for every reading, so that nothing is left of an earlier one.
  std::vector<uint16_t> read(const void *depth, int32_t stride, const AmplitudeView &amplitude = {}) {
    Arena measured_state, measured_scratch;
    DepthReader::layout(config_, measured_state, measured_scratch, nullptr);
    state_.assign(measured_state.used() + kArenaAlignment, 0xEE);
    scratch_.assign(measured_scratch.used() + kArenaAlignment, 0xEE);
    Arena state(test::alignedStart(&state_)), scratch(test::alignedStart(&scratch_));
    reader_ = {};
    DepthReader::layout(config_, state, scratch, &reader_);
    reader_.init(config_);
    view_ = reader_.read({static_cast<const uint8_t *>(depth), kReaderWidth, kReaderHeight, stride}, amplitude);
    std::vector<uint16_t> z;
    for (int32_t y = 0; y < kReaderHeight; ++y) z.insert(z.end(), view_.row(y), view_.row(y) + kReaderWidth);
    return z;
  }
  std::vector<uint16_t> readUnits() { return read(units_.data(), 2 * kReaderWidth); }
  uint16_t &at(int32_t x, int32_t y) { return units_[static_cast<size_t>(y * kReaderWidth + x)]; }

  DepthReaderConfig config_;
  std::vector<uint16_t> units_;
  ImageView<uint16_t> view_;

 private:
  std::vector<uint8_t> state_, scratch_;
  DepthReader reader_;
};

TEST_F(DepthReaderTest, UnitsAreReadInPlace) {
  EXPECT_EQ(readUnits(), units_);
  EXPECT_EQ(view_.data, units_.data());
  Arena state, scratch;
  DepthReader::layout(config_, state, scratch, nullptr);
  EXPECT_EQ(state.used() + scratch.used(), 0u);
}

TEST_F(DepthReaderTest, TwelveBitsArePackedInPairs) {
  config_.layout.kind = DepthLayout::kPacked12;
  std::vector<uint8_t> packed;
  for (size_t i = 0; i < units_.size(); i += 2) {
    const uint16_t a = units_[i], b = units_[i + 1];
    packed.push_back(static_cast<uint8_t>(a >> 4));
    packed.push_back(static_cast<uint8_t>(b >> 4));
    packed.push_back(static_cast<uint8_t>((b & 15) << 4 | (a & 15)));
  }
  EXPECT_EQ(read(packed.data(), kReaderWidth * 3 / 2), units_);
}

TEST_F(DepthReaderTest, MetresAreRoundedToUnits) {
  config_.layout.kind = DepthLayout::kMetres;
  std::vector<float> metres;
  for (const uint16_t units : units_) metres.push_back(0.001f * static_cast<float>(units) + 0.0004f);
  EXPECT_EQ(read(metres.data(), 4 * kReaderWidth), units_);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const float none[] = {nan, inf, -inf, -1, 0, 0.0004f, 1e30f};
  std::copy(none, none + 7, metres.begin());
  metres[7] = 65.6f;
  metres[8] = 1500;  // millimetres
  const std::vector<uint16_t> z = read(metres.data(), 4 * kReaderWidth);
  for (size_t i = 0; i < 7; ++i) EXPECT_EQ(z[i], 0) << none[i];
  EXPECT_EQ(z[7], 65535);
  EXPECT_EQ(z[8], 65535);
  EXPECT_EQ(z[9], units_[9]);
}

// Of a wall across the axis every z is the same, and every range is z over the cosine to the axis.
TEST_F(DepthReaderTest, RangesBecomeDepths) {
  config_.layout.is_range = true;
  const double z_units = 2000;
  std::vector<float> metres;
  for (int32_t y = 0; y < kReaderHeight; ++y) {
    for (int32_t x = 0; x < kReaderWidth; ++x) {
      const double u = (x + 0.5 - kReaderWidth / 2.0) / 5, v = (y + 0.5 - kReaderHeight / 2.0) / 5;
      const double range = z_units * std::sqrt(1 + u * u + v * v);
      at(x, y) = static_cast<uint16_t>(range + 0.5);
      metres.push_back(static_cast<float>(range / 1000));
    }
  }
  for (const uint16_t z : readUnits()) EXPECT_NEAR(z, z_units, 1);
  config_.layout.kind = DepthLayout::kMetres;
  for (const uint16_t z : read(metres.data(), 4 * kReaderWidth)) EXPECT_NEAR(z, z_units, 1);
}

// The longest range stays within 16 bits on the axis itself, and where no ray has a pixel there is no depth.
TEST_F(DepthReaderTest, RangesAtTheirLimits) {
  config_.layout.is_range = true;
  config_.camera = Camera(test::pinhole(kReaderWidth, kReaderHeight, 1e6));
  units_.assign(units_.size(), 65535);
  for (const uint16_t z : readUnits()) EXPECT_GE(z, 65534);
  units_.assign(units_.size(), 2000);
  for (const uint16_t z : readUnits()) EXPECT_EQ(z, 2000) << "rounded to the nearest";
  units_.assign(units_.size(), 65535);
  sphc_camera fisheye = test::pinhole(kReaderWidth, kReaderHeight, 1);
  fisheye.model = SPHC_CAMERA_KANNALA_BRANDT4;
  fisheye.param_count = 8;
  config_.camera = Camera(fisheye);
  EXPECT_EQ(readUnits()[0], 0);  // more than 89 degrees off the axis
}

TEST_F(DepthReaderTest, FaintMeasurementsAreDropped) {
  config_.least_amplitude = 300;
  units_.assign(units_.size(), 1500);
  std::vector<uint8_t> light;
  for (int32_t i = 0; i < kReaderWidth * kReaderHeight; ++i) {
    const int32_t amplitude = 290 + i;
    light.push_back(static_cast<uint8_t>(amplitude & 255));
    light.push_back(static_cast<uint8_t>(amplitude >> 8));
  }
  AmplitudeView amplitude = {{light.data(), kReaderWidth, kReaderHeight, 2 * kReaderWidth}, 2};
  std::vector<uint16_t> z = read(units_.data(), 2 * kReaderWidth, amplitude);
  for (size_t i = 0; i < z.size(); ++i) EXPECT_EQ(z[i], i < 10 ? 0 : 1500) << i;

  config_.least_amplitude = 2;
  const std::vector<uint8_t> bytes = {1, 2, 255, 0, 3, 3, 3, 3};
  amplitude = {{bytes.data(), kReaderWidth, kReaderHeight, 0}, 1};  // every row the same
  z = read(units_.data(), 2 * kReaderWidth, amplitude);
  for (size_t i = 0; i < z.size(); ++i) EXPECT_EQ(z[i] == 0, i % 8 == 0 || i % 8 == 3) << i;
}

TEST_F(DepthReaderTest, FlyingPixelsAreDropped) {
  config_.least_amplitude = 1;
  units_.assign(units_.size(), 1000);
  for (int32_t y = 0; y < kReaderHeight; ++y) {
    at(3, y) = 1300;
    at(4, y) = 1700;
    for (int32_t x = 5; x < kReaderWidth; ++x) at(x, y) = 2000;
  }
  const std::vector<uint16_t> z = readUnits();
  for (int32_t y = 0; y < kReaderHeight; ++y)
    for (int32_t x = 0; x < kReaderWidth; ++x)
      EXPECT_EQ(z[static_cast<size_t>(y * kReaderWidth + x)], x == 3 || x == 4 ? 0 : at(x, y)) << x << ", " << y;
}

TEST_F(DepthReaderTest, FlyingRowsAreDroppedToo) {
  config_.least_amplitude = 1;
  units_.assign(units_.size(), 2000);
  for (int32_t x = 0; x < kReaderWidth; ++x) {
    at(x, 0) = at(x, 1) = 1000;
    at(x, 2) = 1500;
  }
  const std::vector<uint16_t> z = readUnits();
  for (int32_t y = 0; y < kReaderHeight; ++y)
    EXPECT_EQ(z[static_cast<size_t>(y * kReaderWidth + 4)] == 0, y == 2) << y;
}

// A slope, an edge without a pixel between, and a thin thing before a wall are measurements.
TEST_F(DepthReaderTest, SlopesEdgesAndThinThingsStay) {
  config_.least_amplitude = 1;
  EXPECT_EQ(readUnits(), units_);
  for (int32_t y = 0; y < kReaderHeight; ++y)
    for (int32_t x = 0; x < kReaderWidth; ++x) at(x, y) = x < 4 ? 1000 : 2000;
  EXPECT_EQ(readUnits(), units_);
  for (int32_t y = 0; y < kReaderHeight; ++y)
    for (int32_t x = 0; x < kReaderWidth; ++x) at(x, y) = x == 4 ? 1000 : 2000;
  EXPECT_EQ(readUnits(), units_);
  for (int32_t y = 0; y < kReaderHeight; ++y)
    for (int32_t x = 0; x < kReaderWidth; ++x) at(x, y) = x < 4 ? 0 : x == 4 ? 2000 : 2500;
  EXPECT_EQ(readUnits(), units_) << "a hole is not nearer";
}

}  // namespace
}  // namespace sphc
