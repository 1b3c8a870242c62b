// Poses as other systems state them: their axes, their direction, the order of their numbers.
#pragma once
#include "runtime/geometry/rigid.h"

namespace sphc {

struct Convention {
  // The axes of its camera and of its world, each as one of ours: 1 x, 2 y, 3 z, negative where it points the other
  // way.  Ours of a world are those of the right-handed one.
  int8_t camera_axes[3], world_axes[3];
  int8_t up;               // the axis of ours, of the right-handed world, that is up
  bool needs_world;        // it has a vertical, which a map need not have
  bool camera_from_world;  // states this of a camera, else world_from_camera
  bool rotation_first;     // of the seven numbers
  bool real_first;         // of the quaternion

  int firstOfTranslation() const { return rotation_first ? 4 : 0; }
};

// Null for what is none.
const Convention *conventionOf(sphc_convention convention);

// As rigidToC, of which the sign of the quaternion is always the same, and without -0.
sphc_rigid numbersOf(const Rigid &rigid);

// The world in which `up_map`, of any length but 0, is up; see sphc_convention_make_world.
Rigid makeWorld(const Convention &convention, const Vector3 &up_map);

// Unit quaternion and translation, in the convention's order.
void writeCamera(const Convention &convention, const Rigid &world_from_camera, double pose[7]);
void writeMap(const Convention &convention, const Rigid &world_from_map, double pose[7]);
// The same numbers in the order of sphc_rigid, and nothing else done to them.
sphc_rigid reorder(const Convention &convention, const double pose[7]);
// `numbers` are those of a pose.
Rigid readCamera(const Convention &convention, const sphc_rigid &numbers);  // world_from_camera
Rigid readMap(const Convention &convention, const sphc_rigid &numbers);     // world_from_map

}  // namespace sphc
