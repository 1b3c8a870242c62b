/* Committed files, inside the program: a device may have no others. */
#ifndef PORTABILITY_DATA_H
#define PORTABILITY_DATA_H

#include <stdint.h>

extern const uint8_t data_map[], data_map_end[]; /* room.sphc */
extern const char data_expected[];               /* expected.txt, terminated */

#endif
