// Structs that begin with struct_size grow at the end.  Callers of an older header have fewer fields than this
// library, those of a newer one more: fields that the caller lacks keep their defaults, and fields that the library
// lacks must be zero.
#pragma once
#include <cstddef>

#include "spherecloud/spherecloud_capture.h"

namespace sphc {

struct FieldBytes {
  size_t offset = 0, bytes = 0;
};

struct StructKind {
  const char *type;
  size_t first_bytes;  // when it was first published (tests/abi/headers); a smaller one never was
  size_t known_bytes;  // today
  size_t alignment;
  FieldBytes reserved[5] = {};  // fields that a later library may read, so callers leave them zero
};

// Of a struct that has not grown yet.
template <typename T>
constexpr StructKind ungrown(const char *type) {
  return {type, sizeof(T), sizeof(T), alignof(T)};
}

// Of one whose first version ended where the field at this offset begins.
template <typename T>
constexpr StructKind grown(const char *type, size_t first_bytes) {
  return {type, first_bytes, sizeof(T), alignof(T)};
}

constexpr StructKind kindOf(const sphc_aligned *) { return ungrown<sphc_aligned>("sphc_aligned"); }
constexpr StructKind kindOf(const sphc_aligner_config *) {
  return ungrown<sphc_aligner_config>("sphc_aligner_config");
}
constexpr StructKind kindOf(const sphc_clock_mapper_config *) {
  return ungrown<sphc_clock_mapper_config>("sphc_clock_mapper_config");
}
constexpr StructKind kindOf(const sphc_clock_mapping *) {
  return ungrown<sphc_clock_mapping>("sphc_clock_mapping");
}
constexpr StructKind kindOf(const sphc_features_arrays *) {
  StructKind kind = ungrown<sphc_features_arrays>("sphc_features_arrays");
  kind.reserved[0] = {offsetof(sphc_features_arrays, reserved), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_camera *) {
  StructKind kind = ungrown<sphc_localizer_camera>("sphc_localizer_camera");
  kind.reserved[0] = {offsetof(sphc_localizer_camera, reserved), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_depth_camera *) {
  StructKind kind = ungrown<sphc_localizer_depth_camera>("sphc_localizer_depth_camera");
  kind.reserved[0] = {offsetof(sphc_localizer_depth_camera, reserved), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_depth_view *) {
  StructKind kind = ungrown<sphc_localizer_depth_view>("sphc_localizer_depth_view");
  kind.reserved[0] = {offsetof(sphc_localizer_depth_view, reserved), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_config *) {
  StructKind kind =
      grown<sphc_localizer_config>("sphc_localizer_config", offsetof(sphc_localizer_config, depth_format));
  kind.reserved[0] = {offsetof(sphc_localizer_config, reserved), sizeof(uint32_t)};
  kind.reserved[1] = {offsetof(sphc_localizer_config, reserved2), sizeof(uint32_t)};
  kind.reserved[2] = {offsetof(sphc_localizer_config, reserved3), sizeof(uint32_t)};
  kind.reserved[3] = {offsetof(sphc_localizer_config, reserved4), sizeof(uint32_t)};
  kind.reserved[4] = {offsetof(sphc_localizer_config, reserved5), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_frame *) {
  StructKind kind = grown<sphc_localizer_frame>("sphc_localizer_frame", offsetof(sphc_localizer_frame, reserved2));
  kind.reserved[0] = {offsetof(sphc_localizer_frame, reserved), sizeof(uint32_t)};
  kind.reserved[1] = {offsetof(sphc_localizer_frame, reserved2), sizeof(uint64_t)};
  kind.reserved[2] = {offsetof(sphc_localizer_frame, reserved3), sizeof(uint32_t)};
  kind.reserved[3] = {offsetof(sphc_localizer_frame, reserved4), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_map_info *) {
  return grown<sphc_map_info>("sphc_map_info", offsetof(sphc_map_info, band));
}
constexpr StructKind kindOf(const sphc_pairer_config *) {
  return ungrown<sphc_pairer_config>("sphc_pairer_config");
}
constexpr StructKind kindOf(const sphc_pairer_counts *) {
  return ungrown<sphc_pairer_counts>("sphc_pairer_counts");
}
constexpr StructKind kindOf(const sphc_localizer_prior *) {
  StructKind kind = ungrown<sphc_localizer_prior>("sphc_localizer_prior");
  kind.reserved[0] = {offsetof(sphc_localizer_prior, reserved), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_view *) {
  StructKind kind = ungrown<sphc_localizer_view>("sphc_localizer_view");
  kind.reserved[0] = {offsetof(sphc_localizer_view, reserved), sizeof(uint32_t)};
  return kind;
}
constexpr StructKind kindOf(const sphc_localizer_parameter_range *) {
  return ungrown<sphc_localizer_parameter_range>("sphc_localizer_parameter_range");
}
constexpr StructKind kindOf(const sphc_localizer_prediction *) {
  return ungrown<sphc_localizer_prediction>("sphc_localizer_prediction");
}
constexpr StructKind kindOf(const sphc_localizer_result *) {
  return grown<sphc_localizer_result>("sphc_localizer_result", offsetof(sphc_localizer_result, jump_m));
}

// Of any of them.
sphc_status readStructBytes(const StructKind &kind, const char *name, const void *from, void *known,
                            sphc_message *message);
sphc_status checkStructBytes(const StructKind &kind, const char *name, const void *to, sphc_message *message,
                             uint32_t *struct_size);
void writeStructBytes(const StructKind &kind, const void *known, uint32_t struct_size, void *to);
sphc_status initStructBytes(const StructKind &kind, const void *known, size_t struct_size, void *to);

// Copies what the caller's struct has over *known, which has the defaults; known->struct_size becomes that of this
// library.  `name` is that of the argument.  ARGUMENT for null, STRUCT_SIZE for a size that never was, UNSUPPORTED
// where a field that is reserved or not known here is not zero.
template <typename T>
sphc_status readStruct(const char *name, const T *from, T *known, sphc_message *message) {
  return readStructBytes(kindOf(from), name, from, known, message);
}
// Can it be written?  ARGUMENT for null, STRUCT_SIZE for a size that never was.  The size is read here alone, so
// that a struct that another thread changes meanwhile is written no further than this.
template <typename T>
sphc_status checkStruct(const char *name, const T *to, sphc_message *message, uint32_t *struct_size) {
  return checkStructBytes(kindOf(to), name, to, message, struct_size);
}
// Does element `index` of an array say the struct_size that all have, that of the first?
sphc_status checkElementSize(const char *name, uint32_t index, const void *first, const void *element,
                             sphc_message *message);
// Reads an array of structs, which lie struct_size of the first apart, over the defaults in *known.
template <typename T>
sphc_status readStructs(const char *name, const T *from, uint32_t count, T *known, sphc_message *message) {
  sphc_status status = SPHC_OK;
  const auto *bytes = reinterpret_cast<const unsigned char *>(from);
  for (uint32_t i = 0; i < count && status == SPHC_OK; ++i) {
    const T *element = from ? reinterpret_cast<const T *>(bytes + size_t{i} * from->struct_size) : nullptr;
    status = checkElementSize(name, i, from, element, message);
    if (status == SPHC_OK) status = readStruct(name, element, known + i, message);
  }
  return status;
}
// Copies as much as a struct of the checked size has room for and zeroes the rest of it; its own struct_size stays.
template <typename T>
void writeStruct(const T &known, uint32_t struct_size, T *to) {
  writeStructBytes(kindOf(to), &known, struct_size, to);
}
// The same for a caller who tells struct_size beside the struct: the functions that set defaults.
template <typename T>
sphc_status initStruct(const T &defaults, size_t struct_size, T *to) {
  return initStructBytes(kindOf(to), &defaults, struct_size, to);
}

}  // namespace sphc
