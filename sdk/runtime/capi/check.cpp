#include "runtime/capi/check.h"

#include "runtime/base/message.h"
#include "runtime/capi/format.h"
#include "runtime/capi/transform.h"

namespace sphc {

bool inRange(const char *owner, const char *name, double value, double low, double high, sphc_message *message) {
  if (value >= low && value <= high) return true;
  MessageWriter(message) << owner << name << " is " << value << "; it must lie in " << low << " to " << high;
  return false;
}

bool checkMount(const char *name, const sphc_rigid &mount, sphc_message *message) {
  return checkTransform(name, mount, SPHC_RIG_MAX_OFFSET_M, message);
}

sphc_status refuseElement(uint32_t i, sphc_status status, const sphc_message &found, sphc_message *message) {
  MessageWriter(message) << "with i = " << i << ": " << found.text;
  return status;
}

sphc_status checkImage(const char *name, const sphc_image &image, const sphc_camera &camera,
                       const DepthWanted &wanted, sphc_message *message) {
  if (!image.data) {
    MessageWriter(message) << name
                           << " image's data pointer is null; give the pixels, or leave out a frame without";
    return SPHC_E_IMAGE;
  }
  const PixelFormat format = pixelFormatOf(image.format);
  const bool fits = wanted.format ? image.format == wanted.format : format.group_bytes && !format.is_depth;
  if (!fits) {
    MessageWriter text(message);
    text << name << " image has format " << image.format << "; give ";
    if (wanted.format)
      text << sphc_format_name(wanted.format) << " as " << wanted.field << " says, or set that to another";
    else
      text << "GRAY8, RGB8, BGR8 or another that is not of depth";
    return SPHC_E_IMAGE;
  }
  if (image.width != camera.width || image.height != camera.height) {
    MessageWriter(message) << name << " image is " << image.width << " x " << image.height
                           << ", its camera in the config " << camera.width << " x " << camera.height
                           << "; scale neither, give the calibrated size";
    return SPHC_E_IMAGE;
  }
  const uint32_t row = sphc_format_row_bytes(image.format, image.width);
  if (!row) {
    MessageWriter(message) << name << " image is " << image.width << " wide, and " << format.group_pixels
                           << " pixels of its format share bytes; give a multiple";
    return SPHC_E_IMAGE;
  }
  if (image.stride_bytes < row || image.stride_bytes > SPHC_STRIDE_MAX_BYTES ||
      image.stride_bytes % format.alignment) {
    MessageWriter text(message);
    text << name << " image has a stride of " << image.stride_bytes << " bytes; a row has " << row
         << ": give that to " << SPHC_STRIDE_MAX_BYTES;
    if (format.alignment > 1) text << ", a multiple of " << format.alignment;
    return SPHC_E_IMAGE;
  }
  if (reinterpret_cast<uintptr_t>(image.data) % format.alignment) {
    MessageWriter(message) << name << " image's data pointer is not aligned to " << format.alignment
                           << " bytes; begin the pixels there";
    return SPHC_E_IMAGE;
  }
  return SPHC_OK;
}

sphc_status giveMemory(const sphc_memory &need, sphc_memory *memory, sphc_message *message) {
  if (!memory) {
    MessageWriter(message) << "memory is null; give one to write the answer to";
    return SPHC_E_ARGUMENT;
  }
  *memory = need;
  return SPHC_OK;
}

sphc_status checkMemory(const void *memory, size_t bytes, size_t needed, size_t alignment, const char *what,
                        sphc_message *message) {
  if (!memory) {
    MessageWriter(message) << what << " memory is null; give as many bytes as were asked for";
    return SPHC_E_ARGUMENT;
  }
  if (reinterpret_cast<uintptr_t>(memory) % alignment) {
    MessageWriter(message) << what << " memory must be aligned to " << static_cast<uint64_t>(alignment) << " bytes";
    return SPHC_E_MEMORY_ALIGNMENT;
  }
  if (bytes < needed) {
    MessageWriter(message) << what << " memory has " << static_cast<uint64_t>(bytes) << " bytes, "
                           << static_cast<uint64_t>(needed)
                           << " are needed; ask again with this config and this version";
    return SPHC_E_MEMORY_SIZE;
  }
  return SPHC_OK;
}

sphc_status checkApart(const MemoryRange &written, const MemoryRange &other, sphc_message *message) {
  const auto a = reinterpret_cast<uintptr_t>(written.begin), b = reinterpret_cast<uintptr_t>(other.begin);
  const bool apart = a < b ? b - a >= written.bytes : a - b >= other.bytes;
  if (apart) return SPHC_OK;
  MessageWriter(message) << written.name << " memory overlaps " << other.name << "; give it bytes of its own";
  return SPHC_E_ARGUMENT;
}

}  // namespace sphc
