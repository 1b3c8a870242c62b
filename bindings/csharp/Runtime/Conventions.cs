using System;

namespace SphereCloud {
/// <summary>Poses as other systems state them: seven numbers in the system's own order, which Convention tells.
/// world_from_map says where the map lies in the other system's world; null is the map's own frame, for Colmap and Tum
/// alone. All functions: any thread; SpherecloudException where a number is not finite or beyond a limit, or the
/// convention is not known. docs/frames.md has examples.</summary>
public static unsafe class Conventions {
  /// <summary>How many numbers a pose has.</summary>
  public const int PoseLength = 7;

  /// <summary>Gives world_from_map of a level world with the map's origin. `upMap` points upwards in the map's frame and
  /// has any length but 0.</summary>
  public static Rigid MakeWorld(Convention convention, Vector3d upMap) {
    Library.Require();
    Rigid world;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_convention_make_world(convention, (double*)&upMap, &world, &message), ref message);
    return world;
  }

  /// <summary>Writes the camera's pose in the other system's world into the first seven elements.</summary>
  public static void WriteCamera(Convention convention, Rigid? worldFromMap, Rigid cameraFromMap, double[] pose) {
    RequireSeven(pose);
    fixed (double* numbers = pose) WriteCamera(convention, worldFromMap, cameraFromMap, numbers);
  }

  /// <summary>Gives camera_from_map of the camera's pose in the other system's world. With the identity for
  /// `worldFromMap`, camera_from_world.</summary>
  public static Rigid ReadCamera(Convention convention, Rigid? worldFromMap, double[] pose) {
    RequireSeven(pose);
    fixed (double* numbers = pose) return ReadCamera(convention, worldFromMap, numbers);
  }

  /// <summary>Writes the map's pose in the other system's world into the first seven elements.</summary>
  public static void WriteMap(Convention convention, Rigid worldFromMap, double[] pose) {
    RequireSeven(pose);
    fixed (double* numbers = pose) WriteMap(convention, worldFromMap, numbers);
  }

  /// <summary>Gives world_from_map of the map's pose in the other system's world.</summary>
  public static Rigid ReadMap(Convention convention, double[] pose) {
    RequireSeven(pose);
    fixed (double* numbers = pose) return ReadMap(convention, numbers);
  }

  internal static void WriteCamera(Convention convention, Rigid? worldFromMap, Rigid cameraFromMap, double* pose) {
    Library.Require();
    Rigid world = worldFromMap.GetValueOrDefault();
    var message = new Native.sphc_message();
    Rigid* worldAt = worldFromMap != null ? &world : null;
    SpherecloudException.Check(
        Native.sphc_convention_write_camera(convention, worldAt, &cameraFromMap, pose, &message), ref message);
  }

  internal static Rigid ReadCamera(Convention convention, Rigid? worldFromMap, double* pose) {
    Library.Require();
    Rigid world = worldFromMap.GetValueOrDefault(), cameraFromMap;
    var message = new Native.sphc_message();
    Rigid* worldAt = worldFromMap != null ? &world : null;
    SpherecloudException.Check(
        Native.sphc_convention_read_camera(convention, worldAt, pose, &cameraFromMap, &message), ref message);
    return cameraFromMap;
  }

  internal static void WriteMap(Convention convention, Rigid worldFromMap, double* pose) {
    Library.Require();
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_convention_write_map(convention, &worldFromMap, pose, &message), ref message);
  }

  internal static Rigid ReadMap(Convention convention, double* pose) {
    Library.Require();
    Rigid world;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_convention_read_map(convention, pose, &world, &message), ref message);
    return world;
  }

  private static void RequireSeven(double[] pose) {
    if (pose == null) throw new ArgumentNullException(nameof(pose));
    if (pose.Length < PoseLength)
      throw new ArgumentException("a pose has seven numbers; the array has " + pose.Length, nameof(pose));
  }
}

/// <summary>A pose in Unity's left-handed world: x right, y up, z forward, in metres.</summary>
public unsafe struct UnityPose {
  /// <summary>Where it is.</summary>
  public Vector3d PositionM;
  /// <summary>How it is turned; Unity's own order is x, y, z, w.</summary>
  public Quaterniond Rotation;

  /// <summary>Of the camera, as a Transform in the world has it. `worldFromMap` comes from Conventions.MakeWorld or from
  /// <see cref="ReadMap"/>. Throws SpherecloudException where a number is not finite or beyond a limit.</summary>
  public static UnityPose OfCamera(Rigid worldFromMap, Rigid cameraFromMap) {
    double* pose = stackalloc double[Conventions.PoseLength];
    Conventions.WriteCamera(Convention.Unity, worldFromMap, cameraFromMap, pose);
    return Of(pose);
  }

  /// <summary>Of the map: that of a parent of everything that is placed in it.</summary>
  public static UnityPose OfMap(Rigid worldFromMap) {
    double* pose = stackalloc double[Conventions.PoseLength];
    Conventions.WriteMap(Convention.Unity, worldFromMap, pose);
    return Of(pose);
  }

  /// <summary>Gives camera_from_map of a camera that has this pose, such as for a prior. With the identity for
  /// `worldFromMap`, camera_from_world.</summary>
  public Rigid ReadCamera(Rigid worldFromMap) {
    double* pose = stackalloc double[Conventions.PoseLength];
    Put(pose);
    return Conventions.ReadCamera(Convention.Unity, worldFromMap, pose);
  }

  /// <summary>Gives world_from_map of a map that has this pose.</summary>
  public Rigid ReadMap() {
    double* pose = stackalloc double[Conventions.PoseLength];
    Put(pose);
    return Conventions.ReadMap(Convention.Unity, pose);
  }

  private static UnityPose Of(double* p) {
    return new UnityPose { PositionM = new Vector3d(p[0], p[1], p[2]), Rotation = new Quaterniond(p[6], p[3], p[4], p[5]) };
  }

  private void Put(double* p) {
    *(Vector3d*)p = PositionM;
    p[3] = Rotation.X;
    p[4] = Rotation.Y;
    p[5] = Rotation.Z;
    p[6] = Rotation.W;
  }
}
}
