#include "host/recording/foreign/hl2ss_file.h"

#include "host/cameras/rigid_matrix.h"
#include "host/recording/failure.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

namespace {

constexpr std::string_view kHl2ssMagic = "HL2SSV23";
constexpr size_t kMagicBytes = 8, kFileHeadBytes = 14;  // magic, port, length of the user's own bytes
constexpr size_t kVideoBytes = 14, kOptionBytes = 16;
constexpr size_t kDepthBytes = 6;
constexpr size_t kPacketHeadBytes = 12;  // time, length
constexpr uint64_t kTickNs = 100;
constexpr uint32_t kMostPngFilter = 6;
constexpr size_t kMostPackets = 4000000;  // a day of the fastest stream

class Hl2ssReader {
 public:
  explicit Hl2ssReader(const std::filesystem::path &path) : file_(path), window_(file_) {}

  Hl2ssFile run() {
    readHead();
    if (out_.port == kHl2ssVideoPort)
      readVideoHead();
    else if (out_.port == kHl2ssLongThrowPort)
      readDepthHead();
    else
      throw Failure(SPHC_E_UNSUPPORTED, file_.name() +
                                            ": is neither the stream of the colour camera nor of depth "
                                            "(Long Throw); give each file the name it was recorded by");
    while (at_ < window_.fileSize()) {
      out_.is_cut = !readPacket();
      if (out_.is_cut) break;
    }
    return std::move(out_);
  }

 private:
  // The next bytes of the file; throws where it ends.
  ByteReader take(size_t bytes) {
    if (bytes > window_.fileSize() - at_)
      throw Failure(SPHC_E_DEVICE, file_.name() + ": ends within its head; copy it again");
    const ByteView view = window_.at(at_, bytes);
    at_ += bytes;
    return ByteReader(view);
  }

  void readHead() {
    ByteReader head = take(kFileHeadBytes);
    const std::string_view magic = textOf(head.take(kMagicBytes));
    if (magic.substr(0, 5) != kHl2ssMagic.substr(0, 5))
      throw Failure(SPHC_E_DEVICE, file_.name() + ": is no file of hl2ss; copy it again");
    if (magic != kHl2ssMagic)
      throw Failure(SPHC_E_UNSUPPORTED, file_.name() + ": was written by another version of hl2ss than those of " +
                                            std::string(kHl2ssMagic) + "; record with one of them");
    out_.port = head.little<uint16_t>();
    const uint32_t user_bytes = head.little<uint32_t>();
    if (user_bytes > window_.fileSize() - at_)
      throw Failure(SPHC_E_DEVICE, file_.name() + ": ends within its head; copy it again");
    at_ += user_bytes;
  }

  void readVideoHead() {
    ByteReader head = take(kVideoBytes);
    readMode(&head);
    head.take(6);  // the size that was asked for, frames a second, and of how many one was sent
    out_.profile = head.little<uint8_t>();
    if (out_.profile > kHl2ssH265 && out_.profile != kHl2ssUncoded)
      throw Failure(SPHC_E_UNSUPPORTED,
                    file_.name() + ": is video that is neither H.264, H.265 nor uncoded; record one of these");
    head.take(5);  // level, bits a second
    const size_t options = head.little<uint8_t>();
    if (options > 0) take(options * kOptionBytes);
  }

  void readDepthHead() {
    ByteReader head = take(kDepthBytes);
    readMode(&head);
    head.take(1);                            // of how many images one was sent
    out_.profile = head.little<uint32_t>();  // of one byte in older files, in front of a packet's time
    if (out_.profile > kMostPngFilter && out_.profile != kHl2ssUncoded)
      throw Failure(SPHC_E_UNSUPPORTED, file_.name() + kHl2ssTooOld);
  }

  // 0: images alone, 1: each with a pose.
  void readMode(ByteReader *head) {
    const uint8_t mode = head->little<uint8_t>();
    if (mode > 1) throw Failure(SPHC_E_DEVICE, file_.name() + ": holds no images; record in mode 0 or 1");
    pose_bytes_ = mode == 1 ? kHl2ssMatrixBytes : 0;
  }

  // False where the end of the file cuts it.
  bool readPacket() {
    const uint64_t left = window_.fileSize() - at_;
    if (left < kPacketHeadBytes) return false;
    ByteReader head(window_.at(at_, kPacketHeadBytes));
    const uint64_t ticks = head.little<uint64_t>();
    const uint64_t bytes = head.little<uint32_t>();
    if (bytes + pose_bytes_ > left - kPacketHeadBytes) return false;
    if (ticks > INT64_MAX / kTickNs)
      throw Failure(SPHC_E_DEVICE, file_.name() + ": packet " + std::to_string(out_.packets.size()) +
                                       " has no valid time; copy it again");
    if (out_.packets.size() == kMostPackets)
      throw Failure(SPHC_E_UNSUPPORTED, file_.name() + ": has more than " + std::to_string(kMostPackets) +
                                            " packets; record several shorter walks");
    Hl2ssPacket packet = {static_cast<int64_t>(ticks * kTickNs), at_ + kPacketHeadBytes, bytes, {}};
    at_ = packet.start + bytes;
    if (pose_bytes_ > 0) packet.pose = hl2ssRigidFrom(window_.at(at_, pose_bytes_).data);
    at_ += pose_bytes_;
    out_.packets.push_back(std::move(packet));
    return true;
  }

  File file_;
  FileWindow window_;
  uint64_t at_ = 0;
  size_t pose_bytes_ = 0;
  Hl2ssFile out_;
};

}  // namespace

Hl2ssFile readHl2ss(const std::filesystem::path &path) { return Hl2ssReader(path).run(); }

std::optional<sphc_rigid> hl2ssRigidFrom(const uint8_t *floats) {
  float told[16];
  std::memcpy(told, floats, sizeof told);
  double rows[12];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows[4 * row + column] = static_cast<double>(told[4 * column + row]);
  sphc_rigid rigid;
  const bool is_told = told[15] > 0.5f;  // else 0, of a headset that does not know its place
  if (!is_told || !host::rigidFromRows(rows, &rigid)) return {};
  return rigid;
}

}  // namespace sphc::recording
