#include "data.h"

/* Data, not read-only data: the size of the code is measured. */
__asm__(
    ".data\n"
    ".balign 64\n"
    ".globl data_map\n"
    ".globl data_map_end\n"
    "data_map:\n"
    ".incbin \"" DATA_FOLDER
    "/room.sphc\"\n"
    "data_map_end:\n"
    ".globl data_expected\n"
    "data_expected:\n"
    ".incbin \"" DATA_FOLDER
    "/expected.txt\"\n"
    ".byte 0\n"
    ".text\n");
