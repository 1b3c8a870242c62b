#include "host/live/replay_damage.h"

#include "host/base/checked_call.h"

namespace sphc::host {

Damage damageOf(const sphc_replay_info &info) {
  Damage damage;
  damage.is_cut = info.is_cut != 0;
  damage.changed_parts = info.bad_chunk_count;
  damage.lost_images = info.lost_count;
  damage.bad_poses = info.bad_pose_count;
  damage.bad_accelerations = info.bad_acceleration_count;
  return damage;
}

sphc_replay_info infoOf(const sphc_replay *replay) {
  sphc_replay_info info = {};
  info.struct_size = sizeof info;
  orThrow("recording", [&](sphc_message *) { return sphc_replay_get_info(replay, &info); });
  return info;
}

}  // namespace sphc::host
