#include <gtest/gtest.h>

#include <set>
#include <string>

#include "spherecloud/spherecloud_capture.h"

namespace {

struct Pinned {
  sphc_status value;
  const char *name;
  int32_t number;
};
#define SPHC_PIN(name, number) \
  { name, #name, number }
const Pinned kPinned[] = {SPHC_PIN(SPHC_OK, 0),
                          SPHC_PIN(SPHC_AGAIN, 1),
                          SPHC_PIN(SPHC_NOT_LOCALIZED, 2),
                          SPHC_PIN(SPHC_END, 3),
                          SPHC_PIN(SPHC_OUTSIDE, 4),
                          SPHC_PIN(SPHC_E_ARGUMENT, -10),
                          SPHC_PIN(SPHC_E_STRUCT_SIZE, -11),
                          SPHC_PIN(SPHC_E_STATE, -12),
                          SPHC_PIN(SPHC_E_IMAGE, -13),
                          SPHC_PIN(SPHC_E_MEMORY_SIZE, -20),
                          SPHC_PIN(SPHC_E_MEMORY_ALIGNMENT, -21),
                          SPHC_PIN(SPHC_E_CAPACITY, -22),
                          SPHC_PIN(SPHC_E_MAP_FORMAT, -30),
                          SPHC_PIN(SPHC_E_MAP_VERSION, -31),
                          SPHC_PIN(SPHC_E_MAP_CHECKSUM, -32),
                          SPHC_PIN(SPHC_E_MAP_EXTRACTOR, -33),
                          SPHC_PIN(SPHC_E_DEVICE, -40),
                          SPHC_PIN(SPHC_E_DEVICE_LOST, -41),
                          SPHC_PIN(SPHC_E_UNSUPPORTED, -50),
                          SPHC_PIN(SPHC_E_INTERNAL, -90)};

TEST(CInterfaceStatus, ValuesArePinnedAndNamed) {
  for (const Pinned &p : kPinned) {
    EXPECT_EQ(p.value, p.number) << p.name;
    EXPECT_STREQ(sphc_status_name(p.value), p.name);
  }
}

TEST(CInterfaceStatus, UnknownOnesHaveANameToo) {
  std::set<int32_t> known;
  for (const Pinned &p : kPinned) known.insert(p.number);
  for (int32_t status = -200; status < 200; ++status)
    if (!known.count(status)) {
      EXPECT_STREQ(sphc_status_name(status), "SPHC_?");
    }
}

TEST(CInterfaceStatus, OtherPinnedValues) {
  EXPECT_EQ(SPHC_FORMAT_GRAY8, 1);
  EXPECT_EQ(SPHC_FORMAT_RGB8, 2);
  EXPECT_EQ(SPHC_FORMAT_BGR8, 3);
  EXPECT_EQ(SPHC_FORMAT_DEPTH16, 10);
  EXPECT_EQ(SPHC_CAMERA_PINHOLE, 1);
  EXPECT_EQ(SPHC_CAMERA_BROWN5, 2);
  EXPECT_EQ(SPHC_CAMERA_BROWN8, 3);
  EXPECT_EQ(SPHC_CAMERA_KANNALA_BRANDT4, 4);
  EXPECT_EQ(SPHC_OUTCOME_LOCALIZED, 0);
  EXPECT_EQ(SPHC_OUTCOME_FEW_KEYPOINTS, 1);
  EXPECT_EQ(SPHC_OUTCOME_FEW_DEPTHS, 2);
  EXPECT_EQ(SPHC_OUTCOME_FEW_MATCHES, 3);
  EXPECT_EQ(SPHC_OUTCOME_NO_CONSENSUS, 4);
  EXPECT_EQ(SPHC_OUTCOME_UNCERTAIN, 5);
  EXPECT_EQ(SPHC_OUTCOME_DEADLINE, 6);
  EXPECT_EQ(SPHC_OUTCOME_CONTRADICTION, 7);
  EXPECT_EQ(SPHC_STREAM_COLOR, 1);
  EXPECT_EQ(SPHC_STREAM_DEPTH, 2);
}

TEST(CInterfaceStatus, EachFaultHasAName) {
  EXPECT_STREQ(sphc_localizer_fault_name(SPHC_FAULT_DEPTH_RANGE), "SPHC_FAULT_DEPTH_RANGE");
  EXPECT_STREQ(sphc_localizer_fault_name(SPHC_FAULT_VERTICAL_DISAGREES), "SPHC_FAULT_VERTICAL_DISAGREES");
  EXPECT_STREQ(sphc_localizer_fault_name(SPHC_FAULT_MIRRORED), "SPHC_FAULT_MIRRORED");
  for (uint32_t bit = SPHC_FAULT_DEPTH_RANGE; bit <= SPHC_FAULT_FOCAL_DISAGREES; bit <<= 1)
    EXPECT_STRNE(sphc_localizer_fault_name(bit), "SPHC_FAULT_?") << bit;
  EXPECT_STREQ(sphc_localizer_fault_name(0), "SPHC_FAULT_?");
  EXPECT_STREQ(sphc_localizer_fault_name(SPHC_FAULT_FOCAL_DISAGREES << 1), "SPHC_FAULT_?");
}

TEST(CInterfaceStatus, EachCutHasAName) {
  EXPECT_STREQ(sphc_localizer_cut_name(SPHC_CUT_FEATURES), "SPHC_CUT_FEATURES");
  for (uint32_t bit = SPHC_CUT_FEATURES; bit <= SPHC_CUT_VERIFICATION; bit <<= 1)
    EXPECT_STRNE(sphc_localizer_cut_name(bit), "SPHC_CUT_?") << bit;
  EXPECT_STREQ(sphc_localizer_cut_name(0), "SPHC_CUT_?");
  EXPECT_STREQ(sphc_localizer_cut_name(16), "SPHC_CUT_?");
}

TEST(CInterfaceStatus, EachHintHasAName) {
  EXPECT_STREQ(sphc_localizer_hint_name(SPHC_HINT_TOO_DARK), "SPHC_HINT_TOO_DARK");
  EXPECT_STREQ(sphc_localizer_hint_name(SPHC_HINT_AMBIGUOUS), "SPHC_HINT_AMBIGUOUS");
  for (uint32_t bit = SPHC_HINT_TOO_DARK; bit <= SPHC_HINT_AMBIGUOUS; bit <<= 1)
    EXPECT_STRNE(sphc_localizer_hint_name(bit), "SPHC_HINT_?") << bit;
  EXPECT_STREQ(sphc_localizer_hint_name(0), "SPHC_HINT_?");
  EXPECT_STREQ(sphc_localizer_hint_name(64), "SPHC_HINT_?");
}

TEST(CInterfaceStatus, Version) {
  EXPECT_EQ(sphc_abi(), SPHC_ABI);
  const std::string candidate = SPHC_VERSION_CANDIDATE ? "-rc" + std::to_string(SPHC_VERSION_CANDIDATE) : "";
  const std::string version = std::to_string(SPHC_VERSION_MAJOR) + "." + std::to_string(SPHC_VERSION_MINOR) + "." +
                              std::to_string(SPHC_VERSION_PATCH) + candidate;
  EXPECT_EQ(sphc_version_string(), version);
}

}  // namespace
