// Opens the plug-in.
#pragma once

#include "plugin.h"

namespace sphc::libcamera {

// `path` null: the library's own name, where the dynamic linker looks.  It stays loaded until the process ends:
// libcamera leaves things behind that must not lose their code.  Null, with a message, is SPHC_E_UNSUPPORTED.
const sphc_libcamera_plugin *loadPlugin(const char *path, sphc_message *message);

}  // namespace sphc::libcamera
