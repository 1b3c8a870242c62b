/* The call of C that the binding's is compared with: in one process, on one localizer, on the same frames. */
#include <stdint.h>
#include <time.h>

#include <spherecloud/spherecloud.h>

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Nanoseconds that the call took; below 0 where it failed. */
SPHC_API int64_t timed_process(sphc_localizer *localizer, const sphc_localizer_frame *frame,
                               sphc_localizer_result *result);

int64_t timed_process(sphc_localizer *localizer, const sphc_localizer_frame *frame, sphc_localizer_result *result) {
  const int64_t begin = now_ns();
  result->struct_size = sizeof *result;
  const sphc_status status = sphc_localizer_process(localizer, frame, result);
  return status < 0 ? -1 : now_ns() - begin;
}
