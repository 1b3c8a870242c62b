// cameras.txt, images.txt, points3D.txt.  COLMAP's documentation: "Output Format".
#include <algorithm>
#include <charconv>

#include "host/calibration/colmap_camera.h"
#include "host/cameras/fault.h"
#include "host/import/colmap_record.h"
#include "host/recording/text_field.h"

namespace sphc::host {
namespace {

// A line's words in turn.
class Words {
 public:
  Words(const char *file, size_t line, std::string_view text)
      : place_(std::string(file) + ", line " + std::to_string(line)), text_(text) {}

  const std::string &place() const { return place_; }
  bool done() const { return recording::trimmed(text_).empty(); }
  std::string_view rest() const { return recording::trimmed(text_); }
  std::string_view word() { return recording::takeWord(text_); }
  double number() {
    const std::string_view field = word();
    double value = 0;
    if (!recording::parseDouble(field, value)) fail(field, "a number");
    return value;
  }
  template <typename T>
  T integer() {
    const std::string_view field = word();
    T value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || field.empty()) fail(field, "a whole number");
    return value;
  }

 private:
  [[noreturn]] void fail(std::string_view field, const char *wanted) const {
    refuse("COLMAP model", place_, "has " + shown(field) + " where " + wanted + " must be; is it the right file?");
  }

  std::string place_;
  std::string_view text_;
};

// Lines without comments.  Empty ones count: an image without keypoints has one.
class Lines {
 public:
  Lines(const char *file, std::string_view text) : file_(file), text_(text) {}

  bool next(Words *words) {
    while (!text_.empty()) {
      const size_t end = std::min(text_.find('\n'), text_.size());
      const std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++number_;
      if (!line.empty() && line[0] == '#') continue;
      *words = Words(file_, number_, line);
      return true;
    }
    return false;
  }
  // The next one that is not empty.
  bool nextFull(Words *words) {
    while (next(words))
      if (!words->done()) return true;
    return false;
  }

 private:
  const char *file_;
  std::string_view text_;
  size_t number_ = 0;
};

void readTextCameras(const std::string &text, ColmapModel *model) {
  Lines lines("cameras.txt", text);
  for (Words words("cameras.txt", 0, ""); lines.nextFull(&words);) {
    const uint32_t id = words.integer<uint32_t>();
    const std::string_view name = words.word();
    const ColmapCameraModel *known = findColmapModel(name);
    if (!known)
      refuse("COLMAP model", words.place(),
             "camera model is " + shown(name) + "; known here: " + knownColmapModels());
    const uint64_t width = words.integer<uint64_t>(), height = words.integer<uint64_t>();
    std::vector<double> params;
    for (size_t i = 0; i < known->slots.size(); ++i) params.push_back(words.number());
    if (!words.done())
      refuse("COLMAP model", words.place(),
             "has more parameters than its camera model; take the file from COLMAP again");
    addColmapCamera(words.place(), id, *known, width, height, params, model);
  }
}

void readTextImages(const std::string &text, ColmapModel *model) {
  Lines lines("images.txt", text);
  for (Words words("images.txt", 0, ""); lines.nextFull(&words);) {
    const std::string place = words.place();
    const uint32_t id = words.integer<uint32_t>();
    double pose[7];
    for (double &number : pose) number = words.number();
    ColmapImage image;
    image.camera = words.integer<uint32_t>();
    image.name = words.rest();
    if (!lines.next(&words))
      refuse("COLMAP model", place, "has no line of keypoints after it; the file is cut off");
    while (!words.done()) {
      const double x = words.number(), y = words.number();
      words.integer<int64_t>();  // its point; the points' tracks say the same
      image.keypoints_px.emplace_back(x, y);
    }
    addColmapImage(place, id, pose, std::move(image), model);
  }
}

void readTextPoints(const std::string &text, ColmapModel *model) {
  Lines lines("points3D.txt", text);
  for (Words words("points3D.txt", 0, ""); lines.nextFull(&words);) {
    const uint64_t id = words.integer<uint64_t>();
    ColmapPoint point;
    for (int i = 0; i < 3; ++i) point.position[i] = words.number();
    for (int i = 0; i < 3; ++i) words.integer<uint32_t>();  // colour
    words.number();                                         // mean reprojection error
    while (!words.done()) {
      const uint32_t image = words.integer<uint32_t>();
      point.track.push_back({image, words.integer<uint32_t>()});
    }
    addColmapPoint(words.place(), id, std::move(point), model);
  }
}

}  // namespace

ColmapModel parseColmapText(const ColmapFiles &files) {
  ColmapModel model;
  readTextCameras(files.cameras, &model);
  readTextImages(files.images, &model);
  readTextPoints(files.points, &model);
  return model;
}

}  // namespace sphc::host
