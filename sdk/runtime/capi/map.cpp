#include <cstring>
#include <new>

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"
#include "runtime/stages/features/extractor.h"

uint32_t sphc_extractor_id(void) { return sphc::kExtractorId; }

sphc_status sphc_map_memory(sphc_memory *memory) {
  static_assert(sizeof(sphc_map) <= SPHC_MAP_BYTES_MAX);
  if (!memory) return SPHC_E_ARGUMENT;
  *memory = {sizeof(sphc_map), 0, alignof(sphc_map), 0};
  return SPHC_OK;
}

sphc_status sphc_map_init(void *memory, size_t memory_bytes, const void *file, size_t file_bytes, sphc_map **map,
                          sphc_message *message) {
  if (!map || !file) {
    sphc::MessageWriter(message) << (map ? "file is null; give the bytes of a map file"
                                         : "map is null; give a pointer to set");
    return SPHC_E_ARGUMENT;
  }
  const sphc_status memory_status =
      sphc::checkMemory(memory, memory_bytes, sizeof(sphc_map), alignof(sphc_map), "map", message);
  if (memory_status != SPHC_OK) return memory_status;
  const sphc_status apart_status =
      sphc::checkApart({"map", memory, sizeof(sphc_map)}, {"the map file's bytes", file, file_bytes}, message);
  if (apart_status != SPHC_OK) return apart_status;
  if (reinterpret_cast<uintptr_t>(file) % 8) {
    sphc::MessageWriter(message) << "the map file's bytes must be aligned to 8; malloc and mmap do so";
    return SPHC_E_MEMORY_ALIGNMENT;
  }
  sphc::MapView view;
  const sphc_status status = sphc::MapView::open(file, file_bytes, sphc::kExtractorId, &view, message);
  if (status != SPHC_OK) return status;
  *map = new (memory) sphc_map{view};
  return SPHC_OK;
}

sphc_status sphc_map_get_info(const sphc_map *map, sphc_map_info *info) {
  if (!map) return SPHC_E_ARGUMENT;
  uint32_t struct_size = 0;
  const sphc_status status = sphc::checkStruct("info", info, nullptr, &struct_size);
  if (status != SPHC_OK) return status;
  const sphc::MapHeader &header = map->view.header();
  sphc_map_info own = {};
  own.format_version = header.version;
  own.point_count = header.point_count;
  own.extractor = header.extractor;
  own.file_bytes = header.file_bytes;
  own.band = map->view.band();
  std::memcpy(own.map_id, header.map_id, sizeof own.map_id);
  sphc::writeStruct(own, struct_size, info);
  return SPHC_OK;
}

sphc_status sphc_map_direction(const sphc_map *map, uint32_t point_index, double direction[3]) {
  if (!map || !direction || point_index >= map->view.pointCount()) return SPHC_E_ARGUMENT;
  const sphc::Direction d = map->view.direction(point_index);
  direction[0] = static_cast<double>(d.x);
  direction[1] = static_cast<double>(d.y);
  direction[2] = static_cast<double>(d.z);
  return SPHC_OK;
}

void sphc_map_fini(sphc_map **map) {
  if (map) *map = nullptr;
}
