using System;
using SphereCloud;
using UnityEngine;

/// <summary>The types of Unity, by stand-ins.</summary>
internal static class UnityTest {
  public static void PosesGoThereAndBack() {
    Rigid world = Conventions.MakeWorld(Convention.Unity, new Vector3d(0, -1, 0));
    var camera = new Rigid(new Quaterniond(0.5, 0.5, -0.5, 0.5), new Vector3d(1, 2, 3));
    Pose pose = UnityPose.OfCamera(world, camera).ToPose();
    double[] back = Session.Numbers(pose.ToUnityPose().ReadCamera(world));
    Expect.Near(Session.Numbers(camera), back, 1e-6, "pose");
  }

  /// <summary>A camera that looks along the map's z in a map whose y is down stands as a camera of Unity does.</summary>
  public static void TheIdentityStaysTheIdentity() {
    Rigid world = Conventions.MakeWorld(Convention.Unity, new Vector3d(0, -1, 0));
    Pose pose = UnityPose.OfCamera(world, new Rigid(Quaterniond.Identity, new Vector3d(0, 0, -2))).ToPose();
    Expect.Near(new double[] {0, 0, 2}, new double[] {pose.position.x, pose.position.y, pose.position.z}, 1e-6, "position");
    Expect.Near(new double[] {0, 0, 0, 1},
                new double[] {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w}, 1e-6, "rotation");
  }
}
