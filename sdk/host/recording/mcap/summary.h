// The end of an MCAP file: what is where, so that tools need not read it all.
#pragma once

#include "file.h"

namespace sphc::recording {

// Appends summary, footer and magic to a file that ends with its data section.  Learns all from the file itself, so
// that recording needs no memory that grows.  Throws Failure.
void writeSummary(File &file);

}  // namespace sphc::recording
