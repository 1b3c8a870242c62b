/* A program that wants what a release to come has. */
#include "later.h"

int main(void) { return sphc_abi() == SPHC_ABI && sphc_later() == 7 ? 0 : 1; }
