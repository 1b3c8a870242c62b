#include "runtime/geometry/convention.h"

#include "runtime/base/message.h"
#include "runtime/capi/transform.h"

using sphc::Convention;
using sphc::MessageWriter;
using sphc::Rigid;

namespace {

sphc_status refuseConvention(sphc_convention convention, sphc_message *message) {
  MessageWriter(message) << "convention " << convention << " is none that " << sphc_version_string()
                         << " knows; give an SPHC_CONVENTION_ value";
  return SPHC_E_UNSUPPORTED;
}

bool isThere(const char *name, const void *argument, sphc_message *message) {
  if (argument) return true;
  MessageWriter(message) << name << " is null; give one";
  return false;
}

bool isRigid(const char *name, const sphc_rigid *rigid, sphc_message *message) {
  return isThere(name, rigid, message) && sphc::checkTransform(name, *rigid, SPHC_CONVENTION_MAX_OFFSET_M, message);
}

bool isPose(const Convention &known, const double pose[7], sphc_message *message) {
  if (!isThere("pose", pose, message)) return false;
  const sphc_rigid numbers = reorder(known, pose);
  const char *order = known.real_first       ? "qw qx qy qz x y z"
                      : known.rotation_first ? "qx qy qz qw x y z"
                                             : "x y z qx qy qz qw";
  return sphc::checkOffset("pose", "", known.firstOfTranslation(), numbers.t_m, SPHC_CONVENTION_MAX_OFFSET_M,
                           message) &&
         sphc::checkQuaternion("the quaternion of ", "pose", numbers.q_wxyz, order, message);
}

// Null is the map's own frame, where the convention has no vertical that the map might lack.
bool isWorld(const Convention &known, const sphc_rigid *world_from_map, sphc_message *message) {
  if (world_from_map) return isRigid("world_from_map", world_from_map, message);
  if (!known.needs_world) return true;
  MessageWriter(message)
      << "world_from_map is null, and this convention's world has a vertical; say how the map lies "
         "in it: sphc_convention_make_world";
  return false;
}

Rigid worldFromC(const sphc_rigid *world_from_map) {
  return world_from_map ? sphc::rigidFromC(*world_from_map) : Rigid();
}

bool isDirection(const double up_map[3], sphc_message *message) {
  if (!isThere("up_map", up_map, message)) return false;
  const bool finite = sphc::isFinite(up_map[0]) && sphc::isFinite(up_map[1]) && sphc::isFinite(up_map[2]);
  if (finite && (up_map[0] != 0 || up_map[1] != 0 || up_map[2] != 0)) return true;
  MessageWriter(message) << "up_map is (" << up_map[0] << ", " << up_map[1] << ", " << up_map[2]
                         << "); it must be finite and not 0: what is up in the map's frame";
  return false;
}

}  // namespace

sphc_status sphc_convention_make_world(sphc_convention convention, const double up_map[3],
                                       sphc_rigid *world_from_map, sphc_message *message) {
  const Convention *known = sphc::conventionOf(convention);
  if (!known) return refuseConvention(convention, message);
  if (!isDirection(up_map, message) || !isThere("world_from_map", world_from_map, message)) return SPHC_E_ARGUMENT;
  *world_from_map = sphc::numbersOf(sphc::makeWorld(*known, {up_map[0], up_map[1], up_map[2]}));
  return SPHC_OK;
}

sphc_status sphc_convention_write_camera(sphc_convention convention, const sphc_rigid *world_from_map,
                                         const sphc_rigid *camera_from_map, double pose[7], sphc_message *message) {
  const Convention *known = sphc::conventionOf(convention);
  if (!known) return refuseConvention(convention, message);
  if (!isWorld(*known, world_from_map, message) || !isRigid("camera_from_map", camera_from_map, message) ||
      !isThere("pose", pose, message))
    return SPHC_E_ARGUMENT;
  writeCamera(*known, worldFromC(world_from_map) * sphc::rigidFromC(*camera_from_map).inverse(), pose);
  return SPHC_OK;
}

sphc_status sphc_convention_read_camera(sphc_convention convention, const sphc_rigid *world_from_map,
                                        const double pose[7], sphc_rigid *camera_from_map, sphc_message *message) {
  const Convention *known = sphc::conventionOf(convention);
  if (!known) return refuseConvention(convention, message);
  if (!isWorld(*known, world_from_map, message) || !isPose(*known, pose, message) ||
      !isThere("camera_from_map", camera_from_map, message))
    return SPHC_E_ARGUMENT;
  const Rigid world_from_camera = readCamera(*known, reorder(*known, pose));
  *camera_from_map = sphc::numbersOf(world_from_camera.inverse() * worldFromC(world_from_map));
  return SPHC_OK;
}

sphc_status sphc_convention_write_map(sphc_convention convention, const sphc_rigid *world_from_map, double pose[7],
                                      sphc_message *message) {
  const Convention *known = sphc::conventionOf(convention);
  if (!known) return refuseConvention(convention, message);
  if (!isRigid("world_from_map", world_from_map, message) || !isThere("pose", pose, message))
    return SPHC_E_ARGUMENT;
  writeMap(*known, sphc::rigidFromC(*world_from_map), pose);
  return SPHC_OK;
}

sphc_status sphc_convention_read_map(sphc_convention convention, const double pose[7], sphc_rigid *world_from_map,
                                     sphc_message *message) {
  const Convention *known = sphc::conventionOf(convention);
  if (!known) return refuseConvention(convention, message);
  if (!isPose(*known, pose, message) || !isThere("world_from_map", world_from_map, message)) return SPHC_E_ARGUMENT;
  *world_from_map = sphc::numbersOf(readMap(*known, reorder(*known, pose)));
  return SPHC_OK;
}
