using System;
using System.Collections.Generic;
using SphereCloud;

/// <summary>Golden poses of other systems.</summary>
internal static class ConventionTest {
  private static readonly string[] seven = {"0", "1", "2", "3", "4", "5", "6"};
  private static readonly string[] rigid = {"qw", "qx", "qy", "qz", "x", "y", "z"};
  private const double Tolerance = 1e-12;

  public static void PosesAreThoseOfTheTable() {
    List<Row> rows = Row.Read(Environment.GetEnvironmentVariable("SPHERECLOUD_CONVENTIONS"));
    Expect.True(rows.Count > 60, "only " + rows.Count + " poses");
    foreach (Row row in rows) Compare(row);
  }

  private static Rigid RigidOf(Row row, string name) {
    double[] v = row.Numbers(name + "_", rigid);
    return new Rigid(new Quaterniond(v[0], v[1], v[2], v[3]), new Vector3d(v[4], v[5], v[6]));
  }

  private static void Compare(Row row) {
    var convention = (Convention)Enum.Parse(typeof(Convention), row["convention"].Replace("_", ""), true);
    Rigid? told = row.Has("world_from_map_qw") ? RigidOf(row, "world_from_map") : (Rigid?)null;
    Rigid world = told ?? Rigid.Identity, camera = RigidOf(row, "camera_from_map");
    double[] cameraPose = row.Numbers("camera_pose_", seven), mapPose = row.Numbers("map_pose_", seven), pose = new double[7];
    if (row.Has("up_map_x")) {
      double[] up = row.Numbers("up_map_", "x", "y", "z");
      Near(Session.Numbers(world), Session.Numbers(Conventions.MakeWorld(convention, new Vector3d(up[0], up[1], up[2]))), row);
    }
    Conventions.WriteCamera(convention, told, camera, pose);
    Near(cameraPose, pose, row);
    Near(Session.Numbers(camera), Session.Numbers(Conventions.ReadCamera(convention, told, cameraPose)), row);
    Conventions.WriteMap(convention, world, pose);
    Near(mapPose, pose, row);
    Near(Session.Numbers(world), Session.Numbers(Conventions.ReadMap(convention, mapPose)), row);
    if (convention == Convention.Unity) CompareUnity(world, camera, cameraPose, mapPose, row);
  }

  private static void CompareUnity(Rigid world, Rigid camera, double[] cameraPose, double[] mapPose, Row row) {
    UnityPose ofCamera = UnityPose.OfCamera(world, camera), ofMap = UnityPose.OfMap(world);
    Near(cameraPose, Numbers(ofCamera), row);
    Near(mapPose, Numbers(ofMap), row);
    Near(Session.Numbers(camera), Session.Numbers(ofCamera.ReadCamera(world)), row);
    Near(Session.Numbers(world), Session.Numbers(ofMap.ReadMap()), row);
  }

  private static double[] Numbers(UnityPose pose) {
    return new[] {pose.PositionM.X, pose.PositionM.Y, pose.PositionM.Z,
                  pose.Rotation.X, pose.Rotation.Y, pose.Rotation.Z, pose.Rotation.W};
  }

  private static void Near(double[] wanted, double[] found, Row row) {
    Expect.Near(wanted, found, Tolerance, row["scene"] + ", " + row["convention"]);
  }

  public static void WhatIsNoPoseIsRefused() {
    var pose = new double[7];
    Expect.Throws<SpherecloudException>(() => Conventions.WriteCamera(Convention.Unity, null, Rigid.Identity, pose), "world_from_map");
    Expect.Throws<SpherecloudException>(() => Conventions.ReadMap(Convention.Tum, pose), "");
    Expect.Equal(Status.Unsupported,
                 Expect.Throws<SpherecloudException>(() => Conventions.ReadMap((Convention)99, new double[] {0, 0, 0, 0, 0, 0, 1}), "").Status,
                 "status of an unknown convention");
    Expect.Throws<ArgumentException>(() => Conventions.ReadMap(Convention.Tum, new double[6]), "seven");
    Expect.Throws<ArgumentNullException>(() => Conventions.ReadMap(Convention.Tum, (double[])null), "pose");
  }
}
