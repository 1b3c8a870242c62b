#if UNITY_5_3_OR_NEWER
using UnityEngine;

namespace SphereCloud {
/// <summary>From the library's poses to the types of Unity, and back.</summary>
public static class UnityExtensions {
  /// <summary>The same in single precision.</summary>
  public static Vector3 ToVector3(this Vector3d vector) {
    return new Vector3((float)vector.X, (float)vector.Y, (float)vector.Z);
  }

  /// <summary>The same in single precision, in Unity's order.</summary>
  public static Quaternion ToQuaternion(this Quaterniond rotation) {
    return new Quaternion((float)rotation.X, (float)rotation.Y, (float)rotation.Z, (float)rotation.W);
  }

  /// <summary>The same in single precision.</summary>
  public static Pose ToPose(this UnityPose pose) {
    return new Pose(pose.PositionM.ToVector3(), pose.Rotation.ToQuaternion());
  }

  /// <summary>The same in double precision.</summary>
  public static UnityPose ToUnityPose(this Pose pose) {
    // Single precision leaves a quaternion a little longer or shorter than 1; the library takes 1e-3.
    return new UnityPose {
      PositionM = new Vector3d(pose.position.x, pose.position.y, pose.position.z),
      Rotation = new Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)};
  }
}
}
#endif
