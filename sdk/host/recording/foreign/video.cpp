#include "host/recording/foreign/video.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <string>

#include "host/recording/failure.h"
#include "host/recording/foreign/bgr_pixels.h"
#include "host/recording/foreign/mp4_packets.h"

namespace sphc::recording {

namespace {

constexpr int64_t kFirst = std::numeric_limits<int64_t>::min(), kBehindAll = std::numeric_limits<int64_t>::max();
constexpr uint64_t kMostPx = uint64_t{SPHC_CAMERA_MAX_PX} * SPHC_CAMERA_MAX_PX;
constexpr int64_t kMostAheadBytes = int64_t{1} << 28;

int64_t bytesOf(const AVPacket &packet) { return packet.size + int64_t{sizeof packet}; }

}  // namespace

// An image is counted by its time among those of all packets, so one that does not come moves no other.  The
// packets of a file are in the order of decoding, and none is shown before it is decoded.
struct Video::Decoder {
  struct Origin {
    int64_t place;
    bool is_key;
  };
  struct Start {
    int64_t place, time;  // of a packet, and when its image is shown
  };

  explicit Decoder(const std::filesystem::path &file) : packets(file, kMostPx) {}

  // At the last known key image up to this one.
  void begin(int64_t index_wanted) {
    const auto [key_index, start] = *std::prev(starts.upper_bound(index_wanted));
    context = ffmpeg::openedDecoder(packets.codec().codec_id, &packets.codec(), kMostPx);
    packets.seek(start.place);
    index = key_index - 1;
    start_time = start.time;
    is_whole = false;
    ahead.clear();
    ahead_bytes = 0;
    waiting.clear();
    passed.clear();
    counted_to = kFirst;
    damage = {};
  }

  // False where there is none.
  bool readAhead() {
    const int64_t place = packets.place();
    ffmpeg::Packet packet = packets.read();
    if (!packet) return false;
    if (!(packet->flags & AV_PKT_FLAG_DISCARD) && packet->pts >= start_time)
      waiting.emplace(packet->pts, Origin{place, (packet->flags & AV_PKT_FLAG_KEY) != 0});
    counted_to = std::max(counted_to, packet->dts);
    ahead_bytes += bytesOf(*packet);
    ahead.push_back(std::move(packet));
    return true;
  }

  // Whether the packets of all images up to this time are known.
  bool isCounted(int64_t time) {
    while (counted_to < time) {
      if (ahead_bytes > kMostAheadBytes) return false;
      if (!readAhead()) return packets.areAllRead();
    }
    return true;
  }

  int64_t nextPlace() const { return packets.place() - static_cast<int64_t>(ahead.size()); }

  // The next packet goes in; after the last one nothing.
  void send() {
    if (ahead.empty() && !readAhead()) {
      avcodec_send_packet(context.get(), nullptr);
      return;
    }
    const int64_t place = nextPlace();
    const ffmpeg::Packet packet = std::move(ahead.front());
    ahead.pop_front();
    ahead_bytes -= bytesOf(*packet);
    if (packet->size == 0 || avcodec_send_packet(context.get(), packet.get()) < 0) damage.add(place);
  }

  // An image of no use, for one that is shown behind it came before; others may go on from it.
  void takeLate(int64_t time) {
    const auto found = passed.find(time);
    if (found == passed.end())
      damage.add(nextPlace() - 1);
    else
      damage.reaches(*frame, found->second.place);
  }

  // An image came.  Those that are shown before the key image where decoding began count for nothing.
  void take() {
    const int64_t time = frame->pts;
    if (time < start_time) return;
    const bool is_counted = isCounted(time);
    const auto [first, behind] = waiting.equal_range(time);
    if (first == behind) {
      takeLate(time);
      return;
    }
    const Origin origin = first->second;
    index += 1 + std::distance(waiting.begin(), first);
    const bool is_alone = std::next(first) == behind;
    passed.insert(waiting.begin(), first);
    waiting.erase(waiting.begin(), std::next(first));
    is_whole = !damage.reaches(*frame, origin.place) && is_counted && is_alone;
    if (is_whole && origin.is_key && ffmpeg::isKey(*frame)) starts[index] = {origin.place, time};
  }

  // Decodes up to this image, or to one behind it.
  void advance(int64_t index_wanted) {
    while (index < index_wanted) {
      const int status = avcodec_receive_frame(context.get(), frame.get());
      if (status >= 0) {
        take();
      } else if (status == AVERROR_EOF) {
        index = kBehindAll;
      } else {
        if (status != AVERROR(EAGAIN)) damage.add(nextPlace() - 1);
        send();
      }
    }
  }

  Mp4Packets packets;
  uint32_t width = 0, height = 0, count = 0;
  std::map<int64_t, Start> starts{{0, {0, kFirst}}};  // by index: where decoding may begin

  ffmpeg::CodecContext context{};
  ffmpeg::Frame frame{ffmpeg::made(av_frame_alloc())};
  int64_t index = kBehindAll;  // of the image that came last
  bool is_whole = false;       // it
  int64_t start_time = kFirst;
  std::deque<ffmpeg::Packet> ahead{};  // read, to go in
  int64_t ahead_bytes = 0;
  std::multimap<int64_t, Origin> waiting{};  // by time: of images that are to come
  std::multimap<int64_t, Origin> passed{};   // by time: of those that did not
  int64_t counted_to = kFirst;               // time
  ffmpeg::Damage damage{};
  BgrPixels pixels{};
};

Video::Video(const std::filesystem::path &file) : decoder_(std::make_unique<Decoder>(file)) {
  const AVCodecParameters &codec = decoder_->packets.codec();
  const auto side = [](int px) {
    return px > 0 && px <= static_cast<int>(SPHC_CAMERA_MAX_PX) ? static_cast<uint32_t>(px) : 0;
  };
  decoder_->width = side(codec.width);
  decoder_->height = side(codec.height);
  decoder_->count = decoder_->packets.frameCount();
  if (!decoder_->width || !decoder_->height || !decoder_->count)
    throw Failure(SPHC_E_DEVICE, shortPath(file.string()) + ": holds no frames of up to " +
                                     std::to_string(SPHC_CAMERA_MAX_PX) + " pixels a side; copy the video again");
}

Video::~Video() = default;
Video::Video(Video &&) noexcept = default;

uint32_t Video::width() const { return decoder_->width; }
uint32_t Video::height() const { return decoder_->height; }
uint32_t Video::frameCount() const { return decoder_->count; }

sphc_image Video::read(uint32_t index) {
  Decoder &video = *decoder_;
  if (index < video.index) video.begin(index);
  video.advance(index);
  if (video.index != index || !video.is_whole)
    throw Failure(SPHC_E_DEVICE, "cannot be decoded: the video ends or is damaged before it; copy it again");
  return video.pixels.of(*video.frame);
}

}  // namespace sphc::recording
