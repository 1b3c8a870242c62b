// A recording in one MCAP file, as recorder.h writes it.
#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "calibration_json.h"
#include "failure.h"
#include "host/cameras/rigid_matrix.h"
#include "host/recording/foreign/ros_messages.h"
#include "recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kMostSmallBytes = FileWindow::kMostBytes;  // of records that describe
constexpr uint64_t kMostCalibrationBytes = 1 << 20;

// One walk through the file's records.  Of a file whose data have the checksum that was written at their end, all
// is true.  Of another whole file, a chunk is checked when an image of it is read, and at once when it holds poses
// or accelerations, which nobody reads again; of a cut one every chunk is checked, because a power cut may leave
// garbage at its end.
class McapScan {
 public:
  McapScan(const File &file, bool checks_all)
      : file_(file), window_(file), chunks_(file), checks_all_(checks_all) {}

  Recording run();
  bool inOrder() const { return in_order_; }
  // The file says what the checksum of its data is, and it is another one.
  bool isChanged() const { return is_changed_; }
  // Where its data end; 0: nowhere.
  uint64_t dataEnd() const { return data_end_; }
  // recorder.h began it: its topics alone are those of any robot.
  bool isOurs() const { return is_ours_; }
  bool hasChannels() const { return !kinds_.empty(); }
  // Of a chunk that another tool compressed; empty: of none.
  const std::string &compression() const { return compression_; }

 private:
  void readRecord(const RecordPlace &record);
  void readSchemaRecord(ByteView content);
  void readChunkRecords(const RecordPlace &record);
  void readMessage(const RecordPlace &record);
  bool holdsTrueBytes();
  void checkData(uint64_t bytes, uint32_t crc);
  void readSmallMessage(Kind kind, const MessageHead &head, ByteView data);
  void addImage(Kind kind, const MessageHead &head, const RecordPlace &record);
  MessagePlace placeOf(Kind kind, const RecordPlace &record) const;
  void addPose(int64_t time_ns, sphc_rigid pose);
  void addAcceleration(int64_t time_ns, ByteView data);
  void readCalibration(const RecordPlace &record);
  std::optional<ByteView> small(const RecordPlace &record);

  const File &file_;
  FileWindow window_;
  ChunkReader chunks_;
  bool checks_all_;
  bool in_order_ = true;
  bool is_changed_ = false;
  bool is_ours_ = false;
  std::string compression_;
  uint64_t data_end_ = 0;
  std::optional<bool> chunk_is_true_;  // of the chunk being read, once its checksum was compared
  std::map<uint16_t, std::string> schemas_;
  std::map<uint16_t, Kind> kinds_;
  std::optional<CaptureNote> color_note_, depth_note_;  // of the image that comes next
  struct Amplitude {
    MessageHead head;
    MessagePlace place;
  };
  std::optional<Amplitude> amplitude_;  // likewise
  Recording recording_;
};

std::optional<ByteView> McapScan::small(const RecordPlace &record) {
  if (record.bytes > kMostSmallBytes) return {};
  return window_.at(record.content, static_cast<size_t>(record.bytes));
}

void McapScan::readRecord(const RecordPlace &record) {
  const std::optional<ByteView> content = small(record);
  Channel channel;
  if (record.op == Op::kChunk) {
    readChunkRecords(record);
  } else if (record.op == Op::kAttachment) {
    readCalibration(record);
  } else if (record.op == Op::kDataEnd && content) {
    checkData(record.start, readDataEnd(*content));
    data_end_ = record.end();
  } else if (record.op == Op::kMetadata && content) {
    ByteReader reader(*content);
    is_ours_ = is_ours_ || takeText(reader) == "spherecloud";
  } else if (record.op == Op::kSchema && content) {
    readSchemaRecord(*content);
  } else if (record.op == Op::kChannel && content && readChannel(*content, channel)) {
    kinds_[channel.id] = channel.encoding == "cdr" ? kindOf(channel.topic, schemas_[channel.schema]) : Kind::kNone;
  }
}

// A tool that picks topics may drop metadata, and keeps the types of what it picks.
void McapScan::readSchemaRecord(ByteView content) {
  constexpr std::string_view kOurTypes = "spherecloud_msgs/";
  Schema schema;
  if (!readSchema(content, schema)) return;
  schemas_[schema.id] = schema.name;
  is_ours_ = is_ours_ || schema.name.substr(0, kOurTypes.size()) == kOurTypes;
}

void McapScan::readChunkRecords(const RecordPlace &record) {
  ChunkHead head;
  ChunkPlace place;
  if (!readChunk(window_, record, head, place) || (checks_all_ && !chunks_.load(place))) {
    if (head.compression == "zstd" || head.compression == "lz4") compression_ = head.compression;
    ++recording_.bad_chunk_count;
    return;
  }
  recording_.chunks.push_back(place);
  chunk_is_true_.reset();
  const WalkEnd end =
      walkRecords(window_, place.start, place.start + place.bytes, [this](const RecordPlace &inner) {
        if (inner.op == Op::kMessage)
          readMessage(inner);
        else if (inner.op == Op::kSchema || inner.op == Op::kChannel)
          readRecord(inner);
      });
  if (end != WalkEnd::kEdge) in_order_ = false;
}

// The bytes of the chunk being read are those that were written.
bool McapScan::holdsTrueBytes() {
  if (!chunk_is_true_) {
    chunk_is_true_ = chunks_.load(recording_.chunks.back()) != nullptr;
    if (!*chunk_is_true_) ++recording_.bad_chunk_count;
  }
  return *chunk_is_true_;
}

void McapScan::checkData(uint64_t bytes, uint32_t crc) {
  is_changed_ = crc != 0 && crcOfStart(file_, bytes) != crc;
}

void McapScan::readMessage(const RecordPlace &record) {
  if (record.bytes < kMessageHeadBytes) return;
  const uint64_t data_bytes = record.bytes - kMessageHeadBytes;
  const size_t shown = static_cast<size_t>(std::min(data_bytes, kMostSmallBytes - kMessageHeadBytes));
  const ByteView bytes = window_.at(record.content, kMessageHeadBytes + shown);
  MessageHead head;
  readMessageHead(bytes, head);
  const auto known = kinds_.find(head.channel);
  if (known == kinds_.end() || known->second == Kind::kNone || head.time_ns > INT64_MAX) return;
  if (isImage(known->second))
    addImage(known->second, head, record);
  else if (isAmplitude(known->second))
    amplitude_ = {head, placeOf(known->second, record)};
  else
    readSmallMessage(known->second, head, {bytes.data + kMessageHeadBytes, shown});
}

void McapScan::readSmallMessage(Kind kind, const MessageHead &head, ByteView data) {
  CaptureNote note;
  Drop drop;
  sphc_rigid pose;
  if (kind == Kind::kColorCapture && readCaptureNote(data, note))
    color_note_ = note;
  else if (kind == Kind::kDepthCapture && readCaptureNote(data, note))
    depth_note_ = note;
  else if (kind == Kind::kDrops && readDrop(data, drop))
    recording_.lost_count += drop.count;
  else if (kind == Kind::kPose && holdsTrueBytes() && readPoseMessage(data, pose))
    addPose(static_cast<int64_t>(head.time_ns), pose);
  else if (kind == Kind::kAcceleration && holdsTrueBytes())
    addAcceleration(static_cast<int64_t>(head.time_ns), data);
}

MessagePlace McapScan::placeOf(Kind kind, const RecordPlace &record) const {
  return {kind, static_cast<uint32_t>(recording_.chunks.size() - 1), record.content + kMessageHeadBytes,
          record.bytes - kMessageHeadBytes};
}

void McapScan::addImage(Kind kind, const MessageHead &head, const RecordPlace &record) {
  const bool is_color = streamOf(kind) == SPHC_STREAM_COLOR;
  std::vector<RecordedImage> &images = is_color ? recording_.color : recording_.depth;
  std::optional<CaptureNote> &note = is_color ? color_note_ : depth_note_;
  RecordedImage image;
  image.time_ns = static_cast<int64_t>(head.time_ns);
  image.sequence = head.sequence;
  if (note && note->time_ns == image.time_ns && note->sequence == image.sequence) image.note = *note;
  note.reset();
  image.place = placeOf(kind, record);
  if (!is_color) {
    if (amplitude_ && amplitude_->head.time_ns == head.time_ns && amplitude_->head.sequence == head.sequence)
      image.amplitude = amplitude_->place;
    amplitude_.reset();
  }
  if (!images.empty() && images.back().time_ns >= image.time_ns) {
    in_order_ = false;
    ++recording_.lost_count;
    ++recording_.backward_count;
    return;
  }
  images.push_back(std::move(image));
}

void McapScan::addPose(int64_t time_ns, sphc_rigid pose) {
  const std::vector<TimedPose> &poses = recording_.poses.poses();
  const bool is_later = poses.empty() || poses.back().time_ns < time_ns;
  if (is_later && isFinite(pose) && host::normalizeQuaternion(pose.q_wxyz, 1e-2))
    recording_.poses.add(time_ns, pose);
  else
    ++recording_.bad_pose_count;
}

void McapScan::addAcceleration(int64_t time_ns, ByteView data) {
  std::vector<TimedAcceleration> &all = recording_.accelerations;
  RosAcceleration read;
  const double *felt = read.felt_mps2;
  const bool is_later = all.empty() || all.back().time_ns < time_ns;
  if (is_later && readRosAcceleration({data, RosEncoding::kCdr}, read))
    all.push_back({time_ns, {felt[0], felt[1], felt[2]}});
  else
    ++recording_.bad_acceleration_count;
}

void McapScan::readCalibration(const RecordPlace &record) {
  if (record.bytes > kMostCalibrationBytes || recording_.calibration) return;
  Bytes content(static_cast<size_t>(record.bytes));
  file_.read(record.content, content.data(), content.size());
  Attachment attachment;
  if (!readAttachment(viewOf(content), attachment) || attachment.name != "calibration.json") return;
  try {
    recording_.calibration = calibrationFromJson(textOf(attachment.data));
  } catch (const Failure &failure) {
    throw Failure(failure.status(), file_.name() + ", calibration.json in it: " + failure.what());
  }
}

Recording McapScan::run() {
  recording_.layout = Layout::kMcap;
  const WalkEnd end = walkRecords(window_, sizeof kMcapMagic, window_.fileSize(),
                                  [this](const RecordPlace &record) { readRecord(record); });
  recording_.is_cut = end != WalkEnd::kDataEnd;
  return std::move(recording_);
}

// Of changed data, all that is in no chunk is believed unchecked: channels, calibration, where chunks are.  Chunks
// are left out one by one.
void requireBadChunk(const File &file, Recording &recording) {
  ChunkReader chunks(file);
  const auto bad = std::count_if(recording.chunks.begin(), recording.chunks.end(),
                                 [&chunks](const ChunkPlace &place) { return !chunks.load(place); });
  recording.bad_chunk_count = std::max(recording.bad_chunk_count, static_cast<uint32_t>(bad));
  if (recording.bad_chunk_count == 0)
    throw Failure(SPHC_E_DEVICE, file.name() +
                                     ": bytes outside of its chunks have changed since it was written, so it "
                                     "cannot be believed; copy it again from where it was recorded");
}

// Behind the data come an index and a footer, and then the file ends.  What follows may be a whole recording, which
// must not be lost without a word.
void requireEnd(const File &file, FileWindow &window, uint64_t data_end) {
  uint64_t end = 0;
  walkRecords(window, data_end, window.fileSize(), [&end](const RecordPlace &record) {
    if (record.op == Op::kFooter) end = record.end() + sizeof kMcapMagic;
  });
  if (end == 0 || end >= window.fileSize() || !hasMagic(window, end - sizeof kMcapMagic)) return;
  throw Failure(SPHC_E_DEVICE, file.name() + ": its end is at byte " + std::to_string(end) + ", and " +
                                   std::to_string(window.fileSize() - end) +
                                   " bytes follow, as where files were joined; copy it again, or give each "
                                   "recording a file of its own");
}

}  // namespace

Recording openMcap(const fs::path &path) {
  const File file(path);
  FileWindow window(file);
  if (window.fileSize() == 0)
    throw Failure(SPHC_E_DEVICE, file.name() + ": is empty; copy it again from where it was recorded");
  if (!hasMagic(window, 0))
    throw Failure(SPHC_E_DEVICE, file.name() +
                                     ": is no recording by its first bytes, of MCAP, raw, .bag, .mkv or .r3d; copy "
                                     "it again, or give another file or a folder");
  const bool is_whole = hasMagic(window, window.fileSize() - sizeof kMcapMagic);
  McapScan quick(file, !is_whole);
  Recording recording = quick.run();
  if (recording.is_cut && !quick.hasChannels() && recording.chunks.empty() && recording.bad_chunk_count == 0)
    throw Failure(SPHC_E_DEVICE,
                  file.name() + ": was cut before it says what it holds; copy it again from where it was recorded");
  if (!recording.is_cut) requireEnd(file, window, quick.dataEnd());
  if (!quick.isOurs()) return openRosBag(path);
  if (!quick.compression().empty())
    throw Failure(SPHC_E_UNSUPPORTED, file.name() + ": another tool compressed its chunks (" + quick.compression() +
                                          "); \"mcap compress --compression none\" undoes that");
  if (quick.isChanged()) requireBadChunk(file, recording);
  if (is_whole && !quick.inOrder()) recording = McapScan(file, true).run();
  recording.path = path;
  if (recording.color.empty())
    throw Failure(SPHC_E_DEVICE, file.name() + ": holds no colour image" +
                                     (recording.is_cut ? "; it was cut before its first chunk was written"
                                                       : "; record one, or convert it"));
  return recording;
}

}  // namespace sphc::recording
