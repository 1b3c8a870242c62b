// A heap that can be sealed: from then on any use of it ends the program.
//
// Calls of malloc and its kin are caught by the linker's --wrap (tests/memory/CMakeLists.txt), operator new and
// delete by replacing them.
#pragma once

namespace sphc::test {

void sealHeap();
void unsealHeap();

}  // namespace sphc::test
