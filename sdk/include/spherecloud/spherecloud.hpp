// spherecloud.hpp - the C++17 face of spherecloud.h: objects that own their memory and end themselves. Header-only.
//
//     spherecloud::checkAbi().orThrow();
//     spherecloud::AlignedBuffer file;                   // or any 8-byte aligned bytes: mmap, flash, ...
//     spherecloud::readFile("room.sphc", &file).orThrow();
//     spherecloud::Map map;
//     spherecloud::Map::open(file.data(), file.size(), &map).orThrow();
//     sphc_localizer_config config = spherecloud::defaultConfig(); // then set config.rig
//     spherecloud::Localizer localizer;
//     spherecloud::Localizer::make(config, map, &localizer).orThrow();
//     sphc_localizer_result result = spherecloud::emptyResult();
//     spherecloud::Status status = localizer.process(frame, &result);   // never allocates
//
// Every step returns a Status, which is not to be dropped.  Nothing throws but status.orThrow(), with exceptions
// switched on: a failure as spherecloud::Error.  Either habit reads well:
//
//     if (auto status = Map::open(...); !status.ok()) return report(status.text());
//     Map::open(...).orThrow();
//
// What a call means, borrows and may fail with, and its thread class, stand in spherecloud.h.  Objects move and do
// not copy; a moved-from object is empty.  Lifetimes: bytes of the file > Map > Localizer.
#ifndef SPHERECLOUD_SPHERECLOUD_HPP
#define SPHERECLOUD_SPHERECLOUD_HPP

#include <spherecloud/spherecloud.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <new>
#include <utility>
#if defined(__cpp_exceptions)
#include <stdexcept>
#include <string>
#endif

namespace spherecloud {

// ---- status
// ------------------------------------------------------------------------------------------------------

#if defined(__cpp_exceptions)
class Error : public std::runtime_error {
 public:
  Error(sphc_status code, const char *text)
      : std::runtime_error(std::string(text) + " [" + sphc_status_name(code) + "]"), code_(code) {}
  sphc_status code() const { return code_; }

 private:
  sphc_status code_;
};
#endif

// What a call answered, and why it failed.
class [[nodiscard]] Status {
 public:
  Status() = default;
  explicit Status(sphc_status code) : code_(code) {}
  Status(sphc_status code, const char *text) : code_(code) {
    std::snprintf(message_.text, sizeof message_.text, "%s", text);
  }

  bool ok() const { return code_ == SPHC_OK; }
  bool failed() const { return code_ < 0; }  // SPHC_AGAIN, NOT_LOCALIZED and END are answers, not failures
  sphc_status code() const { return code_; }
  const char *name() const { return sphc_status_name(code_); }
  // Cause and cure; the status' name when the library had no more to say.
  const char *text() const { return message_.text[0] != '\0' ? message_.text : name(); }

#if defined(__cpp_exceptions)
  // Throws Error on a failure; else gives the status on.
  const Status &orThrow() const {
    if (failed()) throw Error(code_, text());
    return *this;
  }
#endif

  // For calls of the C interface: status.set(sphc_...(..., status.message())).
  sphc_message *message() { return &message_; }
  Status &set(sphc_status code) {
    code_ = code;
    return *this;
  }

 private:
  sphc_status code_ = SPHC_OK;
  sphc_message message_ = {};
};

// SPHC_E_UNSUPPORTED where the library that was loaded has another ABI than this header: ask before anything else.
inline Status checkAbi() {
  if (sphc_abi() == SPHC_ABI) return Status();
  return Status(SPHC_E_UNSUPPORTED, "the library has another ABI than the header; build with the library's own");
}

// ---- memory
// ------------------------------------------------------------------------------------------------------

// Bytes from the heap at an alignment; zeroed.  data() is null when empty or when there was no memory.
class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  AlignedBuffer(std::size_t size, std::size_t alignment) : alignment_(alignment) {
    data_ = ::operator new(size != 0 ? size : 1, std::align_val_t(alignment), std::nothrow);
    if (!data_) return;
    size_ = size;
    auto *bytes = static_cast<unsigned char *>(data_);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = 0;
  }
  AlignedBuffer(AlignedBuffer &&other) noexcept { swap(other); }
  AlignedBuffer &operator=(AlignedBuffer &&other) noexcept {
    AlignedBuffer moved(std::move(other));
    swap(moved);
    return *this;
  }
  AlignedBuffer(const AlignedBuffer &) = delete;
  AlignedBuffer &operator=(const AlignedBuffer &) = delete;
  ~AlignedBuffer() {
    if (data_) ::operator delete(data_, std::align_val_t(alignment_));
  }

  void *data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  void swap(AlignedBuffer &other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(alignment_, other.alignment_);
  }

  void *data_ = nullptr;
  std::size_t size_ = 0, alignment_ = alignof(std::max_align_t);
};

// The whole file, aligned as sphc_map_init wants it.
inline Status readFile(const char *path, AlignedBuffer *bytes) {
  std::FILE *file = std::fopen(path, "rb");
  if (!file) return Status(SPHC_E_DEVICE, "cannot open the file; check its name and permissions");
  Status status(SPHC_E_DEVICE, "cannot read the file; is it a folder, or a device?");
  // A folder can be opened and has a length, but not a first byte.
  const bool readable = std::fgetc(file) != EOF || std::feof(file);
  if (readable && std::fseek(file, 0, SEEK_END) == 0) {
    const long size = std::ftell(file);
    if (size >= 0 && std::fseek(file, 0, SEEK_SET) == 0) {
      AlignedBuffer buffer(static_cast<std::size_t>(size), 64);
      if (!buffer.data()) {
        status = Status(SPHC_E_MEMORY_SIZE, "not enough memory for the file");
      } else if (std::fread(buffer.data(), 1, buffer.size(), file) == buffer.size()) {
        *bytes = std::move(buffer);
        status = Status();
      }
    }
  }
  std::fclose(file);
  return status;
}

// ---- map
// ---------------------------------------------------------------------------------------------------------

class Map {
 public:
  Map() = default;
  Map(Map &&other) noexcept { swap(other); }
  Map &operator=(Map &&other) noexcept {
    Map moved(std::move(other));
    swap(moved);
    return *this;
  }
  Map(const Map &) = delete;
  Map &operator=(const Map &) = delete;
  ~Map() { sphc_map_fini(&map_); }

  // What a view needs (not the file), for open in the caller's memory.
  static Status memory(sphc_memory *memory) { return Status(sphc_map_memory(memory)); }
  // Validates and views `file`, which is borrowed until the map ends.  Takes a little memory for the view.
  static Status open(const void *file, std::size_t file_bytes, Map *map) {
    sphc_memory need = {};
    const Status status = memory(&need);
    if (!status.ok()) return status;
    Map made;
    made.memory_ = AlignedBuffer(static_cast<std::size_t>(need.state_bytes), need.alignment);
    if (!made.memory_.data()) return Status(SPHC_E_MEMORY_SIZE, "not enough memory for the view of the map");
    return open(made.memory_.data(), made.memory_.size(), file, file_bytes, &made, map);
  }
  // The same in the caller's memory, borrowed too; takes none of its own.
  static Status open(void *memory, std::size_t memory_bytes, const void *file, std::size_t file_bytes, Map *map) {
    Map made;
    return open(memory, memory_bytes, file, file_bytes, &made, map);
  }

  sphc_map_info info() const {
    sphc_map_info info = {};
    info.struct_size = sizeof info;
    if (map_) sphc_map_get_info(map_, &info);
    return info;
  }
  // Unit direction of a point from the sphere centre; SPHC_E_ARGUMENT: there is no such point.
  Status direction(std::uint32_t point_index, std::array<double, 3> *direction) const {
    return Status(sphc_map_direction(map_, point_index, direction->data()));
  }
  const sphc_map *get() const { return map_; }
  explicit operator bool() const { return map_ != nullptr; }

 private:
  static Status open(void *memory, std::size_t memory_bytes, const void *file, std::size_t file_bytes, Map *made,
                     Map *map) {
    Status status;
    status.set(sphc_map_init(memory, memory_bytes, file, file_bytes, &made->map_, status.message()));
    if (status.ok()) *map = std::move(*made);
    return status;
  }
  void swap(Map &other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(map_, other.map_);
  }

  AlignedBuffer memory_;
  sphc_map *map_ = nullptr;
};

// ---- depth alignment
// ---------------------------------------------------------------------------------------------

inline sphc_aligner_config defaultAlignerConfig() {
  sphc_aligner_config config = {};
  sphc_aligner_config_init(&config, sizeof config);
  return config;
}

// Tightly packed images of the colour camera's width; each pointer may be null.
inline sphc_aligned aligned(std::uint32_t width, std::uint16_t *depth, std::uint8_t *mask = nullptr,
                            std::uint8_t *confidence = nullptr) {
  return {sizeof(sphc_aligned), 2 * width, width, width, depth, mask, confidence};
}

class Aligner {
 public:
  Aligner() = default;
  Aligner(Aligner &&other) noexcept { swap(other); }
  Aligner &operator=(Aligner &&other) noexcept {
    Aligner moved(std::move(other));
    swap(moved);
    return *this;
  }
  Aligner(const Aligner &) = delete;
  Aligner &operator=(const Aligner &) = delete;
  ~Aligner() { sphc_aligner_fini(&aligner_); }

  // What an aligner of this config needs, for make in the caller's memory.
  static Status memory(const sphc_aligner_config &config, sphc_memory *memory) {
    Status status;
    return status.set(sphc_aligner_memory(&config, memory, status.message()));
  }
  // Takes its memory from the heap, once, here.
  static Status make(const sphc_aligner_config &config, Aligner *aligner) {
    sphc_memory need = {};
    const Status status = memory(config, &need);
    if (!status.ok()) return status;
    Aligner made;
    made.memory_ = AlignedBuffer(static_cast<std::size_t>(need.state_bytes), need.alignment);
    if (!made.memory_.data()) return Status(SPHC_E_MEMORY_SIZE, "not enough memory for the aligner");
    return make(config, made.memory_.data(), made.memory_.size(), &made, aligner);
  }
  // In the caller's memory, borrowed until the aligner ends; takes none of its own.
  static Status make(const sphc_aligner_config &config, void *memory, std::size_t memory_bytes, Aligner *aligner) {
    Aligner made;
    return make(config, memory, memory_bytes, &made, aligner);
  }

  Status process(const sphc_image &depth, const sphc_aligned &aligned) {
    const sphc_status code = sphc_aligner_process(aligner_, &depth, &aligned);
    return code < 0 && aligner_ ? Status(code, sphc_aligner_message(aligner_)) : Status(code);
  }
  sphc_aligner *get() const { return aligner_; }
  explicit operator bool() const { return aligner_ != nullptr; }

 private:
  static Status make(const sphc_aligner_config &config, void *memory, std::size_t memory_bytes, Aligner *made,
                     Aligner *aligner) {
    Status status;
    status.set(sphc_aligner_init(memory, memory_bytes, &config, &made->aligner_, status.message()));
    if (status.ok()) *aligner = std::move(*made);
    return status;
  }
  void swap(Aligner &other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(aligner_, other.aligner_);
  }

  AlignedBuffer memory_;
  sphc_aligner *aligner_ = nullptr;
};

// ---- localizer
// ---------------------------------------------------------------------------------------------------

inline sphc_localizer_config defaultConfig() {
  sphc_localizer_config config = {};
  sphc_localizer_config_init(&config, sizeof config);
  return config;
}

inline sphc_localizer_result emptyResult() {
  sphc_localizer_result result = {};
  sphc_localizer_result_init(&result, sizeof result);
  return result;
}

inline sphc_localizer_prediction emptyPrediction() {
  sphc_localizer_prediction prediction = {};
  sphc_localizer_prediction_init(&prediction, sizeof prediction);
  return prediction;
}

// The probability that the camera is within so many metres and radians of the pose.
inline double confidenceWithin(const sphc_localizer_result &result, double translation_m, double rotation_rad) {
  return sphc_localizer_result_confidence(&result, translation_m, rotation_rad);
}

// What a colour image shows, between the two halves of a frame.
class Features {
 public:
  Features() = default;
  Features(Features &&other) noexcept { swap(other); }
  Features &operator=(Features &&other) noexcept {
    Features moved(std::move(other));
    swap(moved);
    return *this;
  }
  Features(const Features &) = delete;
  Features &operator=(const Features &) = delete;
  ~Features() { sphc_features_fini(&features_); }

  // What features need, for make in the caller's memory.
  static Status memory(const sphc_localizer_config &config, sphc_memory *memory) {
    Status status;
    return status.set(sphc_features_memory(&config, memory, status.message()));
  }
  // For localizers of this config.  Takes its memory from the heap, once, here.
  static Status make(const sphc_localizer_config &config, Features *features) {
    sphc_memory need = {};
    const Status status = memory(config, &need);
    if (!status.ok()) return status;
    Features made;
    made.memory_ = AlignedBuffer(static_cast<std::size_t>(need.state_bytes), need.alignment);
    if (!made.memory_.data()) return Status(SPHC_E_MEMORY_SIZE, "not enough memory for the features");
    return make(config, made.memory_.data(), made.memory_.size(), &made, features);
  }
  // In the caller's memory, borrowed until they end; takes none of its own.
  static Status make(const sphc_localizer_config &config, void *memory, std::size_t memory_bytes,
                     Features *features) {
    Features made;
    return make(config, memory, memory_bytes, &made, features);
  }

  // Features of other hardware; of the frame the colour image and its time are read.
  Status set(const sphc_localizer_frame &frame, const sphc_features_arrays &arrays) {
    return said(sphc_features_set(features_, &frame, &arrays));
  }
  // Borrowed until they are filled again.  SPHC_E_STATE: of no frame yet.
  Status arrays(sphc_features_arrays *arrays) const {
    arrays->struct_size = sizeof *arrays;
    return Status(sphc_features_get(features_, arrays));
  }
  // With its message where it failed: of set, and of Localizer::extract.
  Status said(sphc_status code) const {
    return code < 0 ? Status(code, sphc_features_message(features_)) : Status(code);
  }
  sphc_features *get() const { return features_; }
  explicit operator bool() const { return features_ != nullptr; }

 private:
  static Status make(const sphc_localizer_config &config, void *memory, std::size_t memory_bytes, Features *made,
                     Features *features) {
    Status status;
    status.set(sphc_features_init(memory, memory_bytes, &config, &made->features_, status.message()));
    if (status.ok()) *features = std::move(*made);
    return status;
  }
  void swap(Features &other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(features_, other.features_);
  }

  AlignedBuffer memory_;
  sphc_features *features_ = nullptr;
};

class Localizer {
 public:
  Localizer() = default;
  Localizer(Localizer &&other) noexcept { swap(other); }
  Localizer &operator=(Localizer &&other) noexcept {
    Localizer moved(std::move(other));
    swap(moved);
    return *this;
  }
  Localizer(const Localizer &) = delete;
  Localizer &operator=(const Localizer &) = delete;
  ~Localizer() { sphc_localizer_fini(&localizer_); }

  // What a localizer of this config needs, for make in the caller's memory.
  static Status memory(const sphc_localizer_config &config, sphc_memory *memory) {
    Status status;
    return status.set(sphc_localizer_memory(&config, memory, status.message()));
  }
  // Takes its memory from the heap, once, here.  It has no map yet.
  static Status make(const sphc_localizer_config &config, Localizer *localizer) {
    sphc_memory need = {};
    const Status status = memory(config, &need);
    if (!status.ok()) return status;
    Localizer made;
    made.state_ = AlignedBuffer(static_cast<std::size_t>(need.state_bytes), need.alignment);
    made.scratch_ = AlignedBuffer(static_cast<std::size_t>(need.scratch_bytes), need.alignment);
    if (!made.state_.data() || !made.scratch_.data())
      return Status(SPHC_E_MEMORY_SIZE, "not enough memory for the localizer; lower config.max_keypoints");
    return make(config, made.state_.data(), made.state_.size(), made.scratch_.data(), made.scratch_.size(), &made,
                localizer);
  }
  // In the caller's memory, borrowed until the localizer ends; takes none of its own.
  static Status make(const sphc_localizer_config &config, void *state, std::size_t state_bytes, void *scratch,
                     std::size_t scratch_bytes, Localizer *localizer) {
    Localizer made;
    return make(config, state, state_bytes, scratch, scratch_bytes, &made, localizer);
  }
  // With one map, whose id is 0.
  static Status make(const sphc_localizer_config &config, const Map &map, Localizer *localizer) {
    Localizer made;
    Status status = make(config, &made);
    if (status.ok()) status = made.setMap(0, map);
    if (status.ok()) *localizer = std::move(made);
    return status;
  }

  // Adds the map or replaces the one of this id; it is borrowed until it is replaced or removed.
  Status setMap(std::uint32_t map_id, const Map &map) {
    return said(sphc_localizer_set_map(localizer_, map_id, map.get()));
  }
  Status removeMap(std::uint32_t map_id) { return said(sphc_localizer_remove_map(localizer_, map_id)); }
  // Where the map lies in a frame that maps share.
  Status setMapTransform(std::uint32_t map_id, const sphc_rigid &common_from_map, double rotation_sigma_rad,
                         double translation_sigma_m) {
    return said(sphc_localizer_set_map_transform(localizer_, map_id, &common_from_map, rotation_sigma_rad,
                                                 translation_sigma_m));
  }
  // As at first: the map lies in no frame that maps share.
  Status removeMapTransform(std::uint32_t map_id) {
    return said(sphc_localizer_set_map_transform(localizer_, map_id, nullptr, 0, 0));
  }
  std::uint32_t mapCount() const { return sphc_localizer_map_count(localizer_); }
  Status setParameter(sphc_localizer_parameter parameter, double value) {
    return said(sphc_localizer_set_parameter(localizer_, parameter, value));
  }
  Status parameter(sphc_localizer_parameter parameter, double *value) const {
    return Status(sphc_localizer_get_parameter(localizer_, parameter, value));
  }
  // What it is where it was not set, and may be set to.
  static Status parameterRange(sphc_localizer_parameter parameter, sphc_localizer_parameter_range *range) {
    range->struct_size = sizeof *range;
    return Status(sphc_localizer_get_parameter_range(parameter, range));
  }
  Status setDepthBias(const sphc_depth_bias &depth) {
    return said(sphc_localizer_set_depth_bias(localizer_, &depth));
  }

  // ok(): localized.  code() SPHC_NOT_LOCALIZED: result->outcome says why.  failed(): the frame does not fit.
  Status process(const sphc_localizer_frame &frame, sphc_localizer_result *result) {
    return said(sphc_localizer_process(localizer_, &frame, result));
  }
  // The same in two halves: while one thread locates a frame, another may extract the features of the next.
  Status extract(const sphc_localizer_frame &frame, Features *features) {
    return features->said(sphc_localizer_extract(localizer_, &frame, features->get()));
  }
  Status locate(const sphc_localizer_frame &frame, const Features &features, sphc_localizer_result *result) {
    return said(sphc_localizer_locate(localizer_, &frame, features.get(), result));
  }
  // ok(): *prediction is where the camera is at that time.  code() SPHC_NOT_LOCALIZED: not known.
  Status predict(std::int64_t time_ns, sphc_localizer_prediction *prediction) const {
    return Status(sphc_localizer_predict(localizer_, time_ns, prediction));
  }
  // Copies at most `capacity` and returns how many there are.
  std::uint32_t observations(sphc_localizer_observation *observations, std::uint32_t capacity) const {
    std::uint32_t count = 0;
    if (localizer_) sphc_localizer_observations(localizer_, observations, sizeof *observations, capacity, &count);
    return count;
  }
  // The same of the poses that the last frame may have, those of most gain first.
  std::uint32_t hypotheses(sphc_localizer_hypothesis *hypotheses, std::uint32_t capacity) const {
    std::uint32_t count = 0;
    if (localizer_) sphc_localizer_hypotheses(localizer_, hypotheses, sizeof *hypotheses, capacity, &count);
    return count;
  }
  // Forgets where the camera was.
  void reset() { sphc_localizer_reset(localizer_); }
  sphc_localizer *get() const { return localizer_; }
  explicit operator bool() const { return localizer_ != nullptr; }

 private:
  static Status make(const sphc_localizer_config &config, void *state, std::size_t state_bytes, void *scratch,
                     std::size_t scratch_bytes, Localizer *made, Localizer *localizer) {
    Status status;
    status.set(sphc_localizer_init(state, state_bytes, scratch, scratch_bytes, &config, &made->localizer_,
                                   status.message()));
    if (status.ok()) *localizer = std::move(*made);
    return status;
  }
  // With its message where it failed.
  Status said(sphc_status code) const {
    return code < 0 ? Status(code, sphc_localizer_message(localizer_)) : Status(code);
  }
  void swap(Localizer &other) noexcept {
    std::swap(state_, other.state_);
    std::swap(scratch_, other.scratch_);
    std::swap(localizer_, other.localizer_);
  }

  AlignedBuffer state_, scratch_;
  sphc_localizer *localizer_ = nullptr;
};

// ---- cameras
// -----------------------------------------------------------------------------------------------------

// With as many parameters as are given, in the order of the model: camera(SPHC_CAMERA_PINHOLE, 640, 480, {fx, fy,
// cx, cy}).  checkCamera says whether they are right.
template <std::size_t kCount>
sphc_camera camera(sphc_camera_model model, std::uint32_t width, std::uint32_t height,
                   const double (&params)[kCount]) {
  static_assert(kCount <= 12, "no camera model has more than 12 parameters");
  sphc_camera made = {};
  made.model = model;
  made.width = width;
  made.height = height;
  made.param_count = static_cast<std::uint32_t>(kCount);
  for (std::size_t i = 0; i < kCount; ++i) made.params[i] = params[i];
  return made;
}

// Identity and millimetres; the cameras are to be set.
inline sphc_rig defaultRig() {
  sphc_rig rig = {};
  sphc_rig_init(&rig);
  return rig;
}

inline Status checkCamera(const sphc_camera &camera) {
  Status status;
  return status.set(sphc_camera_check(&camera, status.message()));
}

inline Status checkRig(const sphc_rig &rig) {
  Status status;
  return status.set(sphc_rig_check(&rig, status.message()));
}

// ok(): *pixel_px is set.  code() SPHC_OUTSIDE: the camera has no pixel for this point.
inline Status project(const sphc_camera &camera, const std::array<double, 3> &point_m,
                      std::array<double, 2> *pixel_px) {
  return Status(sphc_camera_project(&camera, point_m.data(), pixel_px->data()));
}

// ok(): *bearing, a unit vector, is set.  code() SPHC_OUTSIDE: the camera has none for this pixel.
inline Status unproject(const sphc_camera &camera, const std::array<double, 2> &pixel_px,
                        std::array<double, 3> *bearing) {
  return Status(sphc_camera_unproject(&camera, pixel_px.data(), bearing->data()));
}

// A further camera of a rig, at the colour camera's place; its camera is to be set.
inline sphc_localizer_camera defaultCamera() {
  sphc_localizer_camera camera = {};
  sphc_localizer_camera_init(&camera, sizeof camera);
  return camera;
}

// A further depth camera of a rig, with the defaults of defaultConfig; its camera is to be set.
inline sphc_localizer_depth_camera defaultDepthCamera() {
  sphc_localizer_depth_camera camera = {};
  sphc_localizer_depth_camera_init(&camera, sizeof camera);
  return camera;
}

// ---- frames and poses
// --------------------------------------------------------------------------------------------

// A tightly packed image when stride_bytes is 0.
inline sphc_image image(const void *data, std::uint32_t width, std::uint32_t height, sphc_format format,
                        std::uint32_t stride_bytes = 0) {
  return {data, width, height, stride_bytes != 0 ? stride_bytes : sphc_format_row_bytes(format, width), format};
}

inline sphc_localizer_frame emptyFrame() {
  sphc_localizer_frame frame = {};
  sphc_localizer_frame_init(&frame, sizeof frame);
  return frame;
}

// Says nothing until its flags are set; for frame.prior.
inline sphc_localizer_prior emptyPrior() {
  sphc_localizer_prior prior = {};
  sphc_localizer_prior_init(&prior, sizeof prior);
  return prior;
}

// Images of further cameras; for frame.views and frame.depth_views.
inline sphc_localizer_view emptyView() {
  sphc_localizer_view view = {};
  sphc_localizer_view_init(&view, sizeof view);
  return view;
}

inline sphc_localizer_depth_view emptyDepthView() {
  sphc_localizer_depth_view view = {};
  sphc_localizer_depth_view_init(&view, sizeof view);
  return view;
}

inline sphc_localizer_frame frame(std::uint32_t sequence, std::int64_t color_time_ns, const sphc_image &color,
                                  std::int64_t depth_time_ns, const sphc_image &depth) {
  sphc_localizer_frame made = emptyFrame();
  made.sequence = sequence;
  made.color_time_ns = color_time_ns;
  made.depth_time_ns = depth_time_ns;
  made.color = color;
  made.depth = depth;
  return made;
}

inline sphc_rigid identity() { return {{1, 0, 0, 0}, {0, 0, 0}}; }

// compose(c_from_b, b_from_a) is c_from_a.
inline sphc_rigid compose(const sphc_rigid &c_from_b, const sphc_rigid &b_from_a) {
  sphc_rigid c_from_a = {};
  sphc_rigid_compose(&c_from_b, &b_from_a, &c_from_a);
  return c_from_a;
}

inline sphc_rigid inverse(const sphc_rigid &b_from_a) {
  sphc_rigid a_from_b = {};
  sphc_rigid_inverse(&b_from_a, &a_from_b);
  return a_from_b;
}

inline std::array<double, 3> apply(const sphc_rigid &b_from_a, const std::array<double, 3> &x_a) {
  std::array<double, 3> x_b = {};
  sphc_rigid_apply(&b_from_a, x_a.data(), x_b.data());
  return x_b;
}

// ---- poses as other systems state them
// ---------------------------------------------------------------------------

// A world in which `up_map`, of any length but 0, is up.
inline Status makeWorld(sphc_convention convention, const std::array<double, 3> &up_map,
                        sphc_rigid *world_from_map) {
  Status status;
  return status.set(sphc_convention_make_world(convention, up_map.data(), world_from_map, status.message()));
}

// In the convention's order; a null world_from_map is for COLMAP and TUM alone.
inline Status writeCamera(sphc_convention convention, const sphc_rigid *world_from_map,
                          const sphc_rigid &camera_from_map, std::array<double, 7> *pose) {
  Status status;
  return status.set(
      sphc_convention_write_camera(convention, world_from_map, &camera_from_map, pose->data(), status.message()));
}

inline Status readCamera(sphc_convention convention, const sphc_rigid *world_from_map,
                         const std::array<double, 7> &pose, sphc_rigid *camera_from_map) {
  Status status;
  return status.set(
      sphc_convention_read_camera(convention, world_from_map, pose.data(), camera_from_map, status.message()));
}

inline Status writeMap(sphc_convention convention, const sphc_rigid &world_from_map, std::array<double, 7> *pose) {
  Status status;
  return status.set(sphc_convention_write_map(convention, &world_from_map, pose->data(), status.message()));
}

inline Status readMap(sphc_convention convention, const std::array<double, 7> &pose, sphc_rigid *world_from_map) {
  Status status;
  return status.set(sphc_convention_read_map(convention, pose.data(), world_from_map, status.message()));
}

}  // namespace spherecloud

#endif  // SPHERECLOUD_SPHERECLOUD_HPP
