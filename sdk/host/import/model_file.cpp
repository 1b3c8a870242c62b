#include "host/import/model_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "host/base/private_file.h"
#include "host/base/regular_file.h"
#include "host/base/shell_word.h"
#include "host/base/write_file.h"
#include "runtime/map/crc32.h"
#include "runtime/stages/features/extractor.h"

namespace sphc::host {
namespace {

constexpr char kMagic[8] = {'S', 'P', 'H', 'C', 'P', 'R', 'I', 'V'};
constexpr uint16_t kVersion = 1;
constexpr size_t kPointBytes = 4 * sizeof(double) + sizeof(uint32_t) + kDescriptorBytes;
constexpr uint32_t kMostPoints = 1u << 24;
static_assert(kPointBytes == 164 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "docs/private_model.md");

struct Header {
  char magic[8];
  uint16_t version, band;
  uint32_t extractor;
  uint64_t file_bytes;
  uint32_t point_count;
  uint32_t crc32;  // of the whole file with 0 in this field
};
static_assert(sizeof(Header) == 32, "docs/private_model.md");

// Takes values from bytes, or puts them there, one after the other.
template <typename T>
void put(const T &value, uint8_t **at) {
  std::memcpy(*at, &value, sizeof value);
  *at += sizeof value;
}
template <typename T>
void take(const uint8_t **at, T *value) {
  std::memcpy(value, *at, sizeof *value);
  *at += sizeof *value;
}

constexpr char kNoModel[] = "this is no point model; give a file that build --save-model or map --model wrote";

uint32_t crcOf(Header header, const uint8_t *points, size_t bytes) {
  header.crc32 = 0;
  return crc32(crc32(0, &header, sizeof header), points, bytes);
}

[[noreturn]] void refuse(const std::string &why) { throw std::runtime_error(why); }

void checkHeader(const Header &header, const std::vector<uint8_t> &bytes) {
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) refuse(kNoModel);
  if (header.version != kVersion) refuse("it was written by another version of this program; save it anew");
  if (header.band > SPHC_BAND_INFRARED)
    refuse("it is of a band that this program does not know; use the version that saved it");
  if (header.extractor != kExtractorId)
    refuse("its descriptors are of another version of this program; map the recording again");
  if (header.file_bytes != bytes.size() || header.point_count > kMostPoints ||
      bytes.size() != sizeof header + header.point_count * kPointBytes)
    refuse("it is cut or has too many bytes; take the backup, or map the recording again");
  if (header.crc32 != crcOf(header, bytes.data() + sizeof header, bytes.size() - sizeof header))
    refuse("it is damaged; take the backup, or map the recording again");
}

bool isReadable(const ModelPoint &point) { return isInRange(point) && point.observations > 0; }

ModelPoint pointAt(const uint8_t **at) {
  ModelPoint point;
  for (int i = 0; i < 3; ++i) take(at, &point.position_m[i]);
  take(at, &point.sigma_m);
  take(at, &point.observations);
  take(at, &point.descriptor.bytes);
  if (!isReadable(point)) refuse("a point is out of range; take the backup, or map the recording again");
  return point;
}

class File {
 public:
  File(const std::string &path, int flags, mode_t mode) : file_(open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  ~File() {
    if (file_ >= 0) close(file_);
  }
  File(const File &) = delete;
  File &operator=(const File &) = delete;
  int get() const { return file_; }

 private:
  int file_;
};

std::vector<uint8_t> readAll(int file, size_t count) {
  std::vector<uint8_t> bytes(count);
  for (size_t done = 0; done < count;) {
    const ssize_t got = read(file, bytes.data() + done, count - done);
    if (got == 0 || (got < 0 && errno != EINTR)) refuse("it cannot be read to its end; check the disk");
    if (got > 0) done += static_cast<size_t>(got);
  }
  return bytes;
}

// A pipe must not hang, and what others may read is no secret any more.
std::vector<uint8_t> readPrivate(const std::string &path) {
  const File file(path, O_RDONLY | O_NONBLOCK, 0);
  struct stat facts = {};
  if (file.get() < 0 || fstat(file.get(), &facts) != 0)
    refuse(std::string(std::strerror(errno)) + "; is the file there?");
  if (!S_ISREG(facts.st_mode)) refuse("it is no file; give one that build --save-model wrote");
  const auto size = static_cast<uint64_t>(facts.st_size);
  if (size < sizeof(Header) || size > sizeof(Header) + kMostPoints * uint64_t{kPointBytes}) refuse(kNoModel);
  std::vector<uint8_t> bytes = readAll(file.get(), size);
  const bool is_model = std::memcmp(bytes.data(), kMagic, sizeof kMagic) == 0;
  if (is_model && isForOthers(facts.st_mode))
    refuse("others may read it, and it tells where every point is; run: chmod 600 " + shellWord(path));
  return bytes;
}

template <typename Action>
auto named(const std::string &path, const Action &action) {
  try {
    return action();
  } catch (const std::runtime_error &error) {
    throw std::runtime_error("point model " + path + ": " + error.what());
  }
}

}  // namespace

std::vector<uint8_t> encodeModel(const PointModel &model) {
  if (model.points.size() > kMostPoints)
    refuse("a point model has 16777216 points at most; map a part of the place");
  const auto count = static_cast<uint32_t>(model.points.size());
  std::vector<uint8_t> bytes(sizeof(Header) + count * kPointBytes);
  uint8_t *at = bytes.data() + sizeof(Header);
  for (const ModelPoint &point : model.points) {
    if (!isReadable(point)) refuse("a point lies nowhere near, or nobody knows where; are poses in metres?");
    for (int i = 0; i < 3; ++i) put(point.position_m[i], &at);
    put(point.sigma_m, &at);
    put(point.observations, &at);
    put(point.descriptor.bytes, &at);
  }
  Header header = {{}, kVersion, static_cast<uint16_t>(model.band), kExtractorId, bytes.size(), count, 0};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.crc32 = crcOf(header, bytes.data() + sizeof header, bytes.size() - sizeof header);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

PointModel decodeModel(const std::vector<uint8_t> &bytes) {
  Header header;
  if (bytes.size() < sizeof header) refuse(kNoModel);
  std::memcpy(&header, bytes.data(), sizeof header);
  checkHeader(header, bytes);
  PointModel model;
  model.band = header.band;
  model.points.reserve(header.point_count);
  const uint8_t *at = bytes.data() + sizeof header;
  for (uint32_t i = 0; i < header.point_count; ++i) model.points.push_back(pointAt(&at));
  return model;
}

bool isModelFile(const std::string &path) {
  const File file(path, O_RDONLY | O_NONBLOCK, 0);
  char magic[sizeof kMagic] = {};
  return file.get() >= 0 && read(file.get(), magic, sizeof magic) == sizeof magic &&
         std::memcmp(magic, kMagic, sizeof magic) == 0;
}

void writeModelFile(const std::string &path, const PointModel &model) {
  writeFile(path, encodeModel(model), Readers::kOwner);
}

PointModel readModelFile(const std::string &path) {
  checkMayRead(path);
  return named(path, [&] { return decodeModel(readPrivate(path)); });
}

}  // namespace sphc::host
