/* A frame as a program in C has it: what measure/overhead.py compares Python with. */
#define _POSIX_C_SOURCE 200809L
#include <time.h>

#include <spherecloud/spherecloud.h>

static int64_t read_ns(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

int64_t monotonic_ns(void *user);
int64_t monotonic_ns(void *user) {
  (void)user;
  return read_ns(CLOCK_MONOTONIC);
}

typedef sphc_status (*process_fn)(sphc_localizer *, const sphc_localizer_frame *, sphc_localizer_result *);

/* The processor's time in one call; below 0: it failed. */
int64_t time_process(process_fn process, sphc_localizer *localizer, const sphc_localizer_frame *frame,
                     sphc_localizer_result *result);
int64_t time_process(process_fn process, sphc_localizer *localizer, const sphc_localizer_frame *frame,
                     sphc_localizer_result *result) {
  const int64_t begin = read_ns(CLOCK_THREAD_CPUTIME_ID);
  const sphc_status status = process(localizer, frame, result);
  return status < 0 ? status : read_ns(CLOCK_THREAD_CPUTIME_ID) - begin;
}
