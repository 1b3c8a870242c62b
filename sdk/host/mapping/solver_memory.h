// Memory of the solver's libraries.
#pragma once

namespace sphc::host {

// CHOLMOD, by which Ceres factorizes, takes memory from the C library, and Ceres crashes where it gets none.  From
// now on the new handler (std::set_new_handler) is called first, as by operator new.  Of the process, once.
void callNewHandlerForCholmod();

}  // namespace sphc::host
