#include "runtime/base/arena.h"

namespace sphc {

void *Arena::takeBytes(const char *name, size_t bytes) {
  const size_t padded = (bytes + kArenaAlignment - 1) / kArenaAlignment * kArenaAlignment;
  unsigned char *data = memory_ ? memory_ + used_ : nullptr;
  used_ += padded;
  if (visit_) visit_(user_, name, padded);
  return data;
}

}  // namespace sphc
