#include "host/recording/foreign/matroska.h"

#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

// Identifiers of RFC 9559, section 5.
enum Id : uint32_t {
  kHead = 0x1A45DFA3,
  kSegment = 0x18538067,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackName = 0x536E,
  kCodecId = 0x86,
  kCodecPrivate = 0x63A2,
  kContentEncodings = 0x6D80,
  kVideo = 0xE0,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kCluster = 0x1F43B675,
  kClusterTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
  kBlockGroup = 0xA0,
  kBlock = 0xA1,
  kAttachments = 0x1941A469,
  kAttachedFile = 0x61A7,
  kFileName = 0x466E,
  kFileData = 0x465C,
  kTags = 0x1254C367,
  kTag = 0x7373,
  kSimpleTag = 0x67C8,
  kTagName = 0x45A3,
  kTagString = 0x4487,
  kSeekHead = 0x114D9B74,
  kCues = 0x1C53BB6B,
  kChapters = 0x1043A770,
};

constexpr uint64_t kMostScaleNs = 1000000000;
constexpr uint8_t kLacing = 0x06;

// What ends a cluster of unknown size.
bool isOfSegment(uint32_t id) {
  return id == kCluster || id == kInfo || id == kTracks || id == kAttachments || id == kTags || id == kSeekHead ||
         id == kCues || id == kChapters;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path &path) : ebml_(path) {}

  MatroskaFile run() {
    const std::optional<EbmlElement> head = ebml_.elementAt(0, ebml_.size());
    const std::optional<EbmlElement> segment =
        head && head->id == kHead ? ebml_.elementAt(head->end, ebml_.size()) : std::nullopt;
    if (!segment || segment->id != kSegment)
      throw Failure(SPHC_E_DEVICE, ebml_.file().name() + ": is no Matroska file; copy it again");
    result_.is_cut = segment->is_cut;
    readSegment(*segment);
    return std::move(result_);
  }

 private:
  void readSegment(const EbmlElement &segment) {
    for (uint64_t at = segment.start; at < segment.end;) {
      const std::optional<EbmlElement> element = ebml_.elementAt(at, segment.end);
      if (!element || element->is_cut) result_.is_cut = true;
      if (!element) return;
      at = element->id == kCluster ? readCluster(*element) : element->end;
      if (element->id != kCluster && !element->is_cut) readOther(*element);
    }
  }

  void readOther(const EbmlElement &element) {
    if (element.id != kInfo && element.id != kTracks && element.id != kAttachments && element.id != kTags) return;
    forEachIn(ebml_, element, [&](const EbmlElement &child) {
      if (child.id == kTimestampScale && element.id == kInfo) scale_ns_ = ebml_.unsignedOf(child);
      if (child.id == kTrackEntry) readTrack(child);
      if (child.id == kAttachedFile) readAttachment(child);
      if (child.id == kTag)
        forEachIn(ebml_, child, [&](const EbmlElement &tag) {
          if (tag.id == kSimpleTag) readTag(tag);
        });
    });
  }

  void readTrack(const EbmlElement &entry) {
    MatroskaTrack track;
    uint64_t number = 0;
    forEachIn(ebml_, entry, [&](const EbmlElement &child) {
      if (child.id == kTrackNumber) number = ebml_.unsignedOf(child);
      if (child.id == kTrackName) track.name = ebml_.textOf(child);
      if (child.id == kCodecId) track.codec = ebml_.textOf(child);
      if (child.id == kContentEncodings) track.is_encoded = true;
      if (child.id == kCodecPrivate) track.fourcc = fourccOf(child);
      if (child.id == kVideo)
        forEachIn(ebml_, child, [&](const EbmlElement &side) {
          if (side.id == kPixelWidth) track.width = sideOf(side);
          if (side.id == kPixelHeight) track.height = sideOf(side);
        });
    });
    result_.tracks.emplace(number, std::move(track));
  }

  uint32_t sideOf(const EbmlElement &element) {
    return static_cast<uint32_t>(std::min<uint64_t>(ebml_.unsignedOf(element), UINT32_MAX));
  }

  // Of a BITMAPINFOHEADER: its word biCompression.
  std::string fourccOf(const EbmlElement &codec_private) {
    constexpr uint64_t kCompressionAt = 16;
    const std::optional<ByteView> word = ebml_.bytesAt(codec_private.start + kCompressionAt, 4, codec_private.end);
    return word ? std::string(textOf(*word)) : std::string();
  }

  void readAttachment(const EbmlElement &attached) {
    std::string name;
    EbmlElement data;
    forEachIn(ebml_, attached, [&](const EbmlElement &child) {
      if (child.id == kFileName) name = ebml_.textOf(child);
      if (child.id == kFileData) data = child;
    });
    result_.attachments.emplace(std::move(name), data);
  }

  void readTag(const EbmlElement &tag) {
    std::string name, text;
    forEachIn(ebml_, tag, [&](const EbmlElement &child) {
      if (child.id == kTagName) name = ebml_.textOf(child);
      if (child.id == kTagString) text = ebml_.textOf(child);
    });
    result_.tags.emplace(std::move(name), std::move(text));
  }

  // Where the next element of the segment begins.
  uint64_t readCluster(const EbmlElement &cluster) {
    uint64_t timestamp = 0;
    for (uint64_t at = cluster.start; at < cluster.end;) {
      const std::optional<EbmlElement> element = ebml_.elementAt(at, cluster.end);
      if (element && cluster.is_open && isOfSegment(element->id)) return at;
      if (!element || element->is_cut) {
        result_.is_cut = true;
        return cluster.end;
      }
      if (element->id == kClusterTimestamp) timestamp = ebml_.unsignedOf(*element);
      if (element->id == kSimpleBlock) readBlock(*element, timestamp);
      if (element->id == kBlockGroup)
        forEachIn(ebml_, *element, [&](const EbmlElement &child) {
          if (child.id == kBlock) readBlock(child, timestamp);
        });
      at = element->end;
    }
    return cluster.end;
  }

  // A block is the number of its track, a time relative to the cluster's of two bytes, flags, and the frame; or the
  // number of frames less one, their sizes in one of three ways, and the frames.
  void readBlock(const EbmlElement &block, uint64_t cluster_timestamp) {
    uint64_t at = block.start;
    const std::optional<uint64_t> number = ebml_.numberAt(&at, block.end);
    const std::optional<ByteView> head = number ? ebml_.bytesAt(at, 3, block.end) : std::nullopt;
    const auto track = head ? result_.tracks.find(*number) : result_.tracks.end();
    if (track == result_.tracks.end()) {
      ++result_.lost_count;
      return;
    }
    const auto relative = static_cast<int16_t>(head->data[0] << 8 | head->data[1]);
    const bool is_laced = (head->data[2] & kLacing) != 0;
    at += 3;
    const std::optional<ByteView> count = is_laced ? ebml_.bytesAt(at, 1, block.end) : std::nullopt;
    const int64_t time_ns = timeOf(cluster_timestamp, relative);
    if (time_ns < 0 || (is_laced && !count)) {
      ++result_.lost_count;
      return;
    }
    const uint32_t frames = is_laced ? count->data[0] + 1u : 1u;
    track->second.blocks.push_back({time_ns, at, block.end - at, frames});
  }

  // Negative where it is none.
  int64_t timeOf(uint64_t cluster_timestamp, int16_t relative) const {
    if (scale_ns_ == 0 || scale_ns_ > kMostScaleNs) return -1;
    if (cluster_timestamp > static_cast<uint64_t>(INT64_MAX) / 4 / scale_ns_) return -1;
    return (static_cast<int64_t>(cluster_timestamp) + relative) * static_cast<int64_t>(scale_ns_);
  }

  EbmlFile ebml_;
  MatroskaFile result_;
  uint64_t scale_ns_ = 1000000;  // where the file does not say it
};

}  // namespace

MatroskaFile readMatroska(const std::filesystem::path &path) { return Reader(path).run(); }

}  // namespace sphc::recording
