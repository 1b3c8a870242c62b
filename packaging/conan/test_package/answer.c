#include <spherecloud/spherecloud.h>
#include <stdio.h>

int main(void) {
  printf("spherecloud %s, ABI %u\n", sphc_version_string(), (unsigned)sphc_abi());
  return sphc_abi() == SPHC_ABI ? 0 : 1; /* the library's and the header's */
}
