package org.spherecloud;

import java.lang.ref.Reference;
import java.util.Objects;

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
    Failure.check(Native.conventionMakeWorld(valueOf(convention), scratch.address(0), worldFromMap.address,
        scratch.messageAddress()), scratch);
    return worldFromMap;
  }

  /** A camera's pose to the other system, into seven numbers of the caller's. */
  public static void writeCamera(Convention convention, Rigid worldFromMap, Rigid cameraFromMap, double[] pose) {
    Scratch scratch = Scratch.mine();
    Scratch.sized(pose, POSE, "pose");
    Failure.check(Native.conventionWriteCamera(valueOf(convention), addressOrNull(worldFromMap),
        address(cameraFromMap, "cameraFromMap"), scratch.address(0), scratch.messageAddress()), scratch);
    scratch.get(0, pose);
    Reference.reachabilityFence(worldFromMap);
    Reference.reachabilityFence(cameraFromMap);
  }

  /** camera_from_map of a camera's pose in the other system. */
  public static void readCamera(Convention convention, Rigid worldFromMap, double[] pose, Rigid cameraFromMap) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(pose, POSE, "pose"));
    Failure.check(Native.conventionReadCamera(valueOf(convention), addressOrNull(worldFromMap), scratch.address(0),
        address(cameraFromMap, "cameraFromMap"), scratch.messageAddress()), scratch);
    Reference.reachabilityFence(worldFromMap);
    Reference.reachabilityFence(cameraFromMap);
  }

  /** The map's pose in the other system's world, world_from_map in all conventions, into seven numbers of the caller's. */
  public static void writeMap(Convention convention, Rigid worldFromMap, double[] pose) {
    Scratch scratch = Scratch.mine();
    Scratch.sized(pose, POSE, "pose");
    Failure.check(Native.conventionWriteMap(valueOf(convention), addressOrNull(worldFromMap), scratch.address(0),
        scratch.messageAddress()), scratch);
    scratch.get(0, pose);
    Reference.reachabilityFence(worldFromMap);
  }

  /** world_from_map of a map's pose in the other system's world. */
  public static void readMap(Convention convention, double[] pose, Rigid worldFromMap) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(pose, POSE, "pose"));
    Failure.check(Native.conventionReadMap(valueOf(convention), scratch.address(0), address(worldFromMap, "worldFromMap"),
        scratch.messageAddress()), scratch);
    Reference.reachabilityFence(worldFromMap);
  }

  private static int valueOf(Convention convention) {
    return Objects.requireNonNull(convention, "convention").value;
  }

  private static long address(Rigid rigid, String name) {
    return Objects.requireNonNull(rigid, name).address;
  }

  private static long addressOrNull(Rigid rigid) {
    return rigid == null ? 0 : rigid.address;
  }
}
