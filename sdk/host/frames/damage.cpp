#include "host/frames/damage.h"

#include "host/base/counted.h"

namespace sphc::host {

Damage damageOf(const recording::Recording &recording) {
  Damage damage;
  damage.is_cut = recording.is_cut;
  damage.changed_parts = recording.bad_chunk_count;
  damage.lost_images = recording.lost_count - recording.backward_count;
  damage.backward_images = recording.backward_count;
  damage.bad_poses = recording.bad_pose_count;
  damage.bad_accelerations = recording.bad_acceleration_count;
  damage.pose_fault = recording.pose_fault;
  damage.order_faults = recording.order_faults;
  return damage;
}

std::vector<std::string> sentencesOf(const Damage &damage) {
  std::vector<std::string> all;
  if (damage.changed_parts)
    all.push_back("left out: " + counted(damage.changed_parts, "part") +
                  " with changed bytes; copy it again from where it was recorded");
  if (damage.is_cut) all.push_back("it was cut off; all that is whole in it is kept");
  if (damage.lost_images)
    all.push_back("missing: " + counted(damage.lost_images, "image") +
                  ", lost while it was recorded, without a time, or out of order");
  if (damage.backward_images)
    all.push_back("left out: " + counted(damage.backward_images, "image") +
                  ", whose times are not after those of the images before them: a clock was set back while it "
                  "recorded, or an image is in it twice; record it again with a clock that only goes forwards");
  if (damage.bad_poses)
    all.push_back("left out: " + counted(damage.bad_poses, "pose") + ", unknown, no rotation, or out of order");
  if (damage.bad_accelerations)
    all.push_back("left out: " + counted(damage.bad_accelerations, "acceleration") +
                  ", zero, not finite, or out of order");
  all.insert(all.end(), damage.order_faults.begin(), damage.order_faults.end());
  if (!damage.pose_fault.empty()) all.push_back(damage.pose_fault);
  return all;
}

}  // namespace sphc::host
