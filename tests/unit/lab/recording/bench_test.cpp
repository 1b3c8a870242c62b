#include "lab/recording/bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sphc::host {
namespace {

using testing::HasSubstr;

std::vector<std::vector<uint16_t>> slopes(uint32_t width, uint32_t height) {
  std::vector<std::vector<uint16_t>> frames(3, std::vector<uint16_t>(size_t{width} * height));
  for (size_t k = 0; k < frames.size(); ++k)
    for (size_t i = 0; i < frames[k].size(); ++i)
      frames[k][i] = static_cast<uint16_t>(i % 50 < 4 ? 0 : 1000 + 100 * k + i / width);
  return frames;
}

TEST(RecordingBench, EveryCodecGivesBackWhatWentIn) {
  const std::vector<uint16_t> frame = slopes(64, 40)[1];
  for (const DepthCodec &codec : depthCodecs(64, 40)) {
    EncodedDepth encoded;
    std::vector<uint16_t> back(frame.size());
    codec.encode(frame, &encoded);
    ASSERT_TRUE(codec.decode(encoded, &back)) << codec.name;
    EXPECT_EQ(back, frame) << codec.name;
    EXPECT_LT(encoded.size(), 2 * frame.size()) << codec.name;
  }
}

TEST(RecordingBench, ComparesWithTheFirstCodec) {
  const CodecTable table = runCodecBench("slopes", 64, 40, slopes(64, 40), 1, [](uint32_t, uint32_t) {});
  ASSERT_EQ(table.rows.size(), depthCodecs(64, 40).size());
  EXPECT_EQ(table.frames, 3u);
  EXPECT_DOUBLE_EQ(table.rows[0].times_slower, 1.0);
  for (const CodecRow &row : table.rows) {
    EXPECT_GT(row.ratio, 1.0) << row.name;
    EXPECT_LE(row.worst_ratio, row.ratio + 1e-9) << row.name;
  }
  EXPECT_THAT(codecResults({table}), HasSubstr("slopes,64,40,3,ours + zstd,"));
  EXPECT_THAT(codecText(table), HasSubstr("64 x 40, 3 depth images"));
}

}  // namespace
}  // namespace sphc::host
