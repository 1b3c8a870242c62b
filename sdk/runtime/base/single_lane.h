// Before the headers of Highway: this file is compiled for single lanes, whatever the others are compiled for.
#pragma once
#undef HWY_COMPILE_ONLY_STATIC
#undef HWY_COMPILE_ONLY_SCALAR
#define HWY_COMPILE_ONLY_SCALAR
