#include "host/recording/foreign/mp4_packets.h"

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "host/recording/foreign/silent_ffmpeg.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

namespace {

// The demuxer takes files of many kinds, and what is found in one may lead to others: only MP4 gets there.
void requireMp4(const std::filesystem::path &path) {
  const File file(path);
  char head[12] = {};
  if (file.size() >= sizeof head) file.read(0, reinterpret_cast<uint8_t *>(head), sizeof head);
  if (std::string_view(head + 4, 4) != "ftyp")
    throw Failure(SPHC_E_DEVICE, file.name() + ": is no MP4 file; copy it again");
}

// By its path from the root: a name may hold what FFmpeg takes for an address.  Other files that it names are not
// opened, which is the demuxer's default.
AVFormatContext *opened(const std::filesystem::path &file) {
  const std::string address = "file:" + std::filesystem::absolute(file).string();
  AVDictionary *options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  AVFormatContext *context = nullptr;
  const int status = avformat_open_input(&context, address.c_str(), av_find_input_format("mov"), &options);
  av_dict_free(&options);
  return status < 0 ? nullptr : context;
}

// What the file's head does not tell of the video, its first packets do.
bool probe(AVFormatContext *context, uint64_t most_px) {
  const std::string most = std::to_string(most_px);
  std::vector<AVDictionary *> of_streams(context->nb_streams, nullptr);
  for (AVDictionary *&options : of_streams) av_dict_set(&options, "max_pixels", most.c_str(), 0);
  const int status = avformat_find_stream_info(context, of_streams.data());
  for (AVDictionary *left : of_streams) av_dict_free(&left);
  return status >= 0;
}

// The first video that is no picture of a cover.
AVStream *chooseVideo(AVFormatContext *context) {
  AVStream *chosen = nullptr;
  for (unsigned i = 0; i < context->nb_streams; ++i) {
    AVStream *stream = context->streams[i];
    const bool is_video =
        stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !(stream->disposition & AV_DISPOSITION_ATTACHED_PIC);
    if (is_video && !chosen)
      chosen = stream;
    else
      stream->discard = AVDISCARD_ALL;
  }
  return chosen;
}

}  // namespace

Mp4Packets::Mp4Packets(const std::filesystem::path &file, uint64_t most_px) {
  requireMp4(file);
  const SilentFfmpeg silent;
  context_.reset(opened(file));
  if (context_ && probe(context_.get(), most_px)) stream_ = chooseVideo(context_.get());
  if (!stream_)
    throw Failure(SPHC_E_DEVICE, shortPath(file.string()) + ": cannot be decoded; copy the video again");
}

uint32_t Mp4Packets::frameCount() const {
  double count = static_cast<double>(stream_->nb_frames);
  if (count <= 0) {
    const double duration_s = static_cast<double>(context_->duration) / AV_TIME_BASE;
    count = std::round(duration_s * av_q2d(av_guess_frame_rate(context_.get(), stream_, nullptr)));
  }
  return count >= 1 && count <= 1e9 ? static_cast<uint32_t>(count) : 0;
}

ffmpeg::Packet Mp4Packets::readAny() {
  ffmpeg::Packet packet(ffmpeg::made(av_packet_alloc()));
  do {
    av_packet_unref(packet.get());
    if (av_read_frame(context_.get(), packet.get()) < 0) return nullptr;
  } while (packet->stream_index != stream_->index);
  return packet->flags & AV_PKT_FLAG_CORRUPT ? nullptr : std::move(packet);
}

ffmpeg::Packet Mp4Packets::read() {
  if (is_over_) return nullptr;
  const SilentFfmpeg silent;
  ffmpeg::Packet packet = found_ ? std::move(found_) : readAny();
  is_over_ = !packet;
  if (packet) ++place_;
  return packet;
}

// The demuxer goes to a key packet at or before a time.
void Mp4Packets::seek(int64_t place) {
  if (place == place_) return;
  const SilentFfmpeg silent;
  const AVIndexEntry *entry = avformat_index_get_entry(stream_, static_cast<int>(place));
  const bool is_sought =
      entry && av_seek_frame(context_.get(), stream_->index, entry->timestamp, AVSEEK_FLAG_BACKWARD) >= 0;
  found_ = is_sought ? readAny() : nullptr;
  while (found_ && found_->dts < entry->timestamp) found_ = readAny();
  is_over_ = !found_ || found_->dts != entry->timestamp;
  place_ = place;
}

}  // namespace sphc::recording
