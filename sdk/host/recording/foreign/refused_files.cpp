// Files of other programs that are known and not read: each has a way out.
#include <string_view>

#include "host/recording/failure.h"
#include "host/recording/mcap/file.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace {

using namespace std::string_view_literals;

struct RefusedKind {
  std::string_view head;
  const char *cure;
};
constexpr RefusedKind kRefusedKinds[] = {
    {"HL2SSV"sv, "is one stream of a recording of hl2ss; give the folder that it is in"},
    {"#ROSBAG V1"sv, "is a bag of ROS 1 of version 1, which is not read: \"rosbag fix\" writes version 2.0"},
    {"SQLite format 3"sv,
     "is a database, as ROS 2's .db3 files are, which is not read: \"ros2 bag convert\" writes MCAP"},
};

}  // namespace

void refuseForeignFile(const std::filesystem::path &path) {
  const File file(path);
  char head[16] = {};
  file.read(0, reinterpret_cast<uint8_t *>(head),
            static_cast<size_t>(std::min<uint64_t>(file.size(), sizeof head)));
  for (const RefusedKind &kind : kRefusedKinds)
    if (std::string_view(head, kind.head.size()) == kind.head)
      throw Failure(SPHC_E_UNSUPPORTED, file.name() + ": " + kind.cure);
}

}  // namespace sphc::recording
