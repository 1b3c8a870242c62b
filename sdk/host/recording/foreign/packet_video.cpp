#include "host/recording/foreign/packet_video.h"

#include <set>

#include "host/recording/failure.h"
#include "host/recording/foreign/ffmpeg.h"

namespace sphc::recording {

namespace {

// From 0 to 255 to video range: Y from 16 to 235, U and V from 16 to 240.
void toVideoRange(int height, cv::Mat *planes) {
  cv::Mat luma = planes->rowRange(0, height), chroma = planes->rowRange(height, planes->rows);
  luma.convertTo(luma, -1, 219 / 255.0, 16);
  chroma.convertTo(chroma, -1, 224 / 255.0, 128 - 128 * 224 / 255.0);
}

cv::Mat planesOf(const AVFrame &frame) {
  const bool is_planar = frame.format == AV_PIX_FMT_YUV420P || frame.format == AV_PIX_FMT_YUVJ420P;
  if (!is_planar || frame.width % 2 != 0 || frame.height % 2 != 0)
    throw Failure(SPHC_E_UNSUPPORTED, "is video of other pixels than 4:2:0 of 8 bits and even sides; record it so");
  cv::Mat planes(frame.height * 3 / 2, frame.width, CV_8UC1);
  uint8_t *out = planes.data;
  for (const int plane : {0, 1, 2}) {
    const int divisor = plane == 0 ? 1 : 2;
    for (int row = 0; row < frame.height / divisor; ++row, out += frame.width / divisor)
      std::memcpy(out, frame.data[plane] + ptrdiff_t{row} * frame.linesize[plane],
                  static_cast<size_t>(frame.width / divisor));
  }
  if (frame.color_range == AVCOL_RANGE_JPEG || frame.format == AV_PIX_FMT_YUVJ420P)
    toVideoRange(frame.height, &planes);
  return planes;
}

}  // namespace

struct PacketVideo::Decoder {
  // From this packet on.
  void open(uint32_t first) {
    context =
        ffmpeg::openedDecoder(code == VideoCode::kH264 ? AV_CODEC_ID_H264 : AV_CODEC_ID_HEVC, nullptr, most_px);
    next = first;
    last = int64_t{first} - 1;
    is_drained = false;
    damage = {};
  }

  // The next packet goes in with its number, which comes out with its image; after the last one nothing.
  void send() {
    is_drained = next == count;
    if (is_drained) {
      avcodec_send_packet(context.get(), nullptr);
      return;
    }
    const ByteView view = packet_bytes(next);
    padded.assign(view.data, view.data + view.size);
    padded.resize(view.size + AV_INPUT_BUFFER_PADDING_SIZE);
    packet->data = padded.data();
    packet->size = static_cast<int>(view.size);
    packet->pts = next;
    const bool is_taken = view.size > 0 && avcodec_send_packet(context.get(), packet.get()) >= 0;
    if (!is_taken) damage.add(next);
    ++next;
  }

  // An image came: those between it and the last one are not to be had, nor is it where it goes on from damage.
  // One that is not behind the last has no number of its own, and what goes on from it neither.
  void take() {
    const int64_t number = frame->pts;
    if (number <= last || number >= count) {
      damage.add(last);
      return;
    }
    for (int64_t i = last + 1; i < number; ++i) is_refused[static_cast<size_t>(i)] = true;
    if (ffmpeg::isKey(*frame)) keys.insert(number);
    if (damage.reaches(*frame, number)) is_refused[static_cast<size_t>(number)] = true;
    last = number;
  }

  // Decodes up to the image of this number, or to one behind it.
  void advance(int64_t index) {
    while (last < index) {
      const int status = avcodec_receive_frame(context.get(), frame.get());
      if (status >= 0) {
        take();
      } else {
        if (status != AVERROR(EAGAIN) && next > 0) damage.add(int64_t{next} - 1);
        if (is_drained) {
          for (int64_t i = last + 1; i < count; ++i) is_refused[static_cast<size_t>(i)] = true;
          return;
        }
        send();
      }
    }
  }

  // Where to begin anew for an image that went by.
  uint32_t keyBefore(int64_t index) const {
    const auto behind = keys.upper_bound(index);
    return behind == keys.begin() ? 0 : static_cast<uint32_t>(*std::prev(behind));
  }

  VideoCode code;
  uint32_t count;
  uint64_t most_px;
  std::function<ByteView(uint32_t)> packet_bytes;
  std::vector<bool> is_refused;  // of each image, once that is known

  ffmpeg::CodecContext context{};
  ffmpeg::Packet packet{ffmpeg::made(av_packet_alloc())};
  ffmpeg::Frame frame{ffmpeg::made(av_frame_alloc())};
  Bytes padded{};
  uint32_t next = 0;  // packet to go in
  int64_t last = -1;  // image that came out
  bool is_drained = false;
  ffmpeg::Damage damage{};
  std::set<int64_t> keys{};  // that were seen
};

PacketVideo::PacketVideo(VideoCode code, uint32_t packet_count, uint64_t most_px,
                         std::function<ByteView(uint32_t)> packet)
    : decoder_(
          new Decoder{code, packet_count, most_px, std::move(packet), std::vector<bool>(packet_count, false)}) {
  decoder_->open(0);
}

PacketVideo::~PacketVideo() = default;

cv::Mat PacketVideo::read(uint32_t index) {
  Decoder &decoder = *decoder_;
  if (!decoder.is_refused[index]) {
    const bool went_by = index <= decoder.last && decoder.frame->pts != index;
    if (went_by) decoder.open(decoder.keyBefore(index));
    decoder.advance(index);
  }
  if (decoder.is_refused[index] || decoder.frame->pts != index)
    throw Failure(SPHC_E_DEVICE,
                  "cannot be decoded: the video begins after it, is damaged before it, or has images that go on "
                  "from later ones (B frames); begin at a later frame, or record without them");
  return planesOf(*decoder.frame);
}

}  // namespace sphc::recording
