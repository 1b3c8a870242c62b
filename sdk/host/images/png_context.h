// What libspng keeps while it reads or writes a file.
#pragma once

#include <spng.h>

#include <memory>

namespace sphc::host {

struct FreePngContext {
  void operator()(spng_ctx *context) const { spng_ctx_free(context); }
};
using PngContext = std::unique_ptr<spng_ctx, FreePngContext>;

}  // namespace sphc::host
