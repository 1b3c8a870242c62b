/* What a release to come might have. */
#include <spherecloud/spherecloud.h>

SPHC_API uint32_t sphc_later(void);
