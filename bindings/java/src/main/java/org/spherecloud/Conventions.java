package org.spherecloud;

import java.lang.ref.Reference;

/**
 * Poses as other systems state them: seven numbers in the order of the {@link Convention}.  {@code worldFromMap} says
 * where the map lies in the other system's world; null is the map's own frame, for COLMAP and TUM alone.  Any thread may
 * call these at any time; those that fill a target of the caller's make no garbage.
 *
 * <p>Each throws {@link SpherecloudException} where a number is not finite or beyond a limit.
 */
public final class Conventions {
  private Conventions() {}

  private static final int POSE = 7;

  /** world_from_map of a gravity-aligned world with the map's origin; {@code upMap} points upwards, of any length but 0. */
  public static Rigid makeWorld(Convention convention, double... upMap) {
    Scratch scratch = Scratch.mine();
    Rigid worldFromMap = new Rigid();
    scratch.put(0, Scratch.sized(upMap, 3, "upMap"));
    Failure.check(Native.conventionMakeWorld(convention.value, scratch.address(0), worldFromMap.address,
        scratch.messageAddress()), scratch);
    return worldFromMap;
  }

  /** A camera's pose to the other system, into seven numbers of the caller's. */
  public static void writeCamera(Convention convention, Rigid worldFromMap, Rigid cameraFromMap, double[] pose) {
    Scratch scratch = Scratch.mine();
    Scratch.sized(pose, POSE, "the pose");
    Failure.check(Native.conventionWriteCamera(convention.value, addressOf(worldFromMap), cameraFromMap.address,
        scratch.address(0), scratch.messageAddress()), scratch);
    scratch.get(0, pose);
    Reference.reachabilityFence(worldFromMap);
    Reference.reachabilityFence(cameraFromMap);
  }

  /** camera_from_map of a camera's pose in the other system. */
  public static void readCamera(Convention convention, Rigid worldFromMap, double[] pose, Rigid cameraFromMap) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(pose, POSE, "the pose"));
    Failure.check(Native.conventionReadCamera(convention.value, addressOf(worldFromMap), scratch.address(0),
        cameraFromMap.address, scratch.messageAddress()), scratch);
    Reference.reachabilityFence(worldFromMap);
    Reference.reachabilityFence(cameraFromMap);
  }

  /** The map's pose in the other system's world, world_from_map in all conventions, into seven numbers of the caller's. */
  public static void writeMap(Convention convention, Rigid worldFromMap, double[] pose) {
    Scratch scratch = Scratch.mine();
    Scratch.sized(pose, POSE, "the pose");
    Failure.check(Native.conventionWriteMap(convention.value, addressOf(worldFromMap), scratch.address(0),
        scratch.messageAddress()), scratch);
    scratch.get(0, pose);
    Reference.reachabilityFence(worldFromMap);
  }

  /** world_from_map of a map's pose in the other system's world. */
  public static void readMap(Convention convention, double[] pose, Rigid worldFromMap) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(pose, POSE, "the pose"));
    Failure.check(Native.conventionReadMap(convention.value, scratch.address(0), worldFromMap.address,
        scratch.messageAddress()), scratch);
    Reference.reachabilityFence(worldFromMap);
  }

  private static long addressOf(Rigid rigid) {
    return rigid == null ? 0 : rigid.address;
  }
}
