#include "host/recording/foreign/packet_video.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

constexpr const char *kCannot =
    "cannot be decoded: the video is damaged before it, or begins after it; copy it again";

template <typename Made>
Made *made(Made *pointer) {
  if (!pointer) throw std::bad_alloc();
  return pointer;
}

bool isFlawed(const AVFrame &frame) {
  return (frame.flags & AV_FRAME_FLAG_CORRUPT) || frame.decode_error_flags != 0;
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
  return planes;
}

}  // namespace

struct PacketVideo::Decoder {
  struct Deleter {
    void operator()(AVCodecContext *context) const { avcodec_free_context(&context); }
    void operator()(AVPacket *packet) const { av_packet_free(&packet); }
    void operator()(AVFrame *frame) const { av_frame_free(&frame); }
  };

  void open() {
    const AVCodec *codec = avcodec_find_decoder(code == VideoCode::kH264 ? AV_CODEC_ID_H264 : AV_CODEC_ID_HEVC);
    if (!codec) throw Failure(SPHC_E_UNSUPPORTED, "this build's libavcodec decodes no such video; install another");
    context.reset(made(avcodec_alloc_context3(codec)));
    context->thread_count = 1;
    context->max_pixels = static_cast<int64_t>(most_px);
    if (avcodec_open2(context.get(), codec, nullptr) < 0) throw Failure(SPHC_E_DEVICE, kCannot);
    next = 0;
    last = -1;
    is_drained = is_damaged = false;
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
    packet->pts = next++;
    const bool is_taken = view.size > 0 && avcodec_send_packet(context.get(), packet.get()) >= 0;
    is_damaged = is_damaged || !is_taken;
  }

  // The image whose number is `index`, if it comes and is whole.
  bool receive(uint32_t index) {
    while (last < index) {
      const int status = avcodec_receive_frame(context.get(), frame.get());
      if (status >= 0) {
        last = frame->pts;
        if (frame->key_frame) is_damaged = false;
        if (isFlawed(*frame)) is_damaged = true;
      } else {
        if (status != AVERROR(EAGAIN)) is_damaged = true;
        if (is_drained) return false;
        send();
      }
    }
    return last == index && !is_damaged;
  }

  VideoCode code;
  uint32_t count;
  uint64_t most_px;
  std::function<ByteView(uint32_t)> packet_bytes;

  std::unique_ptr<AVCodecContext, Deleter> context{};
  std::unique_ptr<AVPacket, Deleter> packet{made(av_packet_alloc())};
  std::unique_ptr<AVFrame, Deleter> frame{made(av_frame_alloc())};
  Bytes padded{};
  uint32_t next = 0;  // packet to go in
  int64_t last = -1;  // image that came out
  bool is_drained = false;
  bool is_damaged = false;  // until an image stands by itself again
};

PacketVideo::PacketVideo(VideoCode code, uint32_t packet_count, uint64_t most_px,
                         std::function<ByteView(uint32_t)> packet)
    : decoder_(new Decoder{code, packet_count, most_px, std::move(packet)}) {
  av_log_set_level(AV_LOG_FATAL);  // failures are told here, with a cause
  decoder_->open();
}

PacketVideo::~PacketVideo() = default;

cv::Mat PacketVideo::read(uint32_t index) {
  if (index <= decoder_->last) decoder_->open();
  if (!decoder_->receive(index)) throw Failure(SPHC_E_DEVICE, kCannot);
  return planesOf(*decoder_->frame);
}

}  // namespace sphc::recording
