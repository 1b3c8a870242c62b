#include "host/report/picture_file.h"

#include <zlib.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "host/report/picture_bytes.h"

namespace sphc::host {
namespace {

constexpr size_t kHeaderEnd = 33;  // of the signature and the chunk IHDR, which is the first

void putBigEndian(uint32_t value, std::vector<uint8_t> *bytes) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes->push_back(static_cast<uint8_t>(value >> shift));
}

// PNG specification, 11.3.4.3 tEXt.
std::vector<uint8_t> markChunk() {
  std::vector<uint8_t> chunk;
  putBigEndian(static_cast<uint32_t>(kPictureMark.size() - 4), &chunk);
  chunk.insert(chunk.end(), kPictureMark.begin(), kPictureMark.end());
  const auto *marked = reinterpret_cast<const uint8_t *>(kPictureMark.data());
  putBigEndian(static_cast<uint32_t>(crc32(0, marked, static_cast<uInt>(kPictureMark.size()))), &chunk);
  return chunk;
}

}  // namespace

const std::string kPictureMark("tEXtSoftware\0spherecloud", 24);

void checkPictureName(const std::string &path) {
  if (std::filesystem::path(path).extension() != ".png")
    throw std::runtime_error("cannot write the picture " + path + ": end its name in .png");
}

void writePicture(const std::string &path, const cv::Mat &picture, Readers readers) {
  checkPictureName(path);
  std::vector<uint8_t> png = pngOf(picture);
  const std::vector<uint8_t> mark = markChunk();
  png.insert(png.begin() + kHeaderEnd, mark.begin(), mark.end());
  writeFile(path, png, readers);
}

}  // namespace sphc::host
