/* What sessions that were compiled against different headers are given and give: atoms, whose layout never changes.
 */
#ifndef ABI_SESSION_H
#define ABI_SESSION_H

#include <spherecloud/spherecloud.h>

typedef struct seen {
  const void *file; /* a map */
  size_t file_bytes;
  sphc_rig rig;
  sphc_image color, depth;
} seen;

enum { KEYPOINTS = 400 };

#define MARK 0x5A /* what lies in memory that nobody has set */
#define CHECK(right) \
  if (!(right)) return __LINE__

/* 0, or the line of what went wrong. */
int session_of_today(const seen *what, sphc_rigid *camera_from_map);
int session_of_another(const seen *what, sphc_rigid *camera_from_map);

#endif
