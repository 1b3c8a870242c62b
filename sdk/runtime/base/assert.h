// Checks of our own logic, in debug builds alone.  Input from outside is never checked by these.
#pragma once

#ifdef NDEBUG
#define SPHC_ASSERT(condition) ((void)sizeof((condition) ? 1 : 0))
#else
#define SPHC_ASSERT(condition) ((condition) ? (void)0 : __builtin_trap())
#endif
