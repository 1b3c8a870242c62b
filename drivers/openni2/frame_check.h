// Whether a frame is what its mode promises; a driver plug-in may hand over anything.
#pragma once

#include <OniCAPI.h>
#include <spherecloud/spherecloud.h>

namespace sphc::openni2 {

// The format that the frames of a mode have here, and the bytes of a pixel; 0: none.
sphc_format formatOf(OniPixelFormat format);

// SPHC_OK, or SPHC_E_IMAGE with what is wrong in `message`.
sphc_status checkFrame(const OniFrame &frame, int stream, const OniVideoMode &mode, sphc_message *message);

}  // namespace sphc::openni2
