using System;
using System.Globalization;
using System.Threading;
using SphereCloud;

/// <summary>Cameras, rigs and rigid transforms.</summary>
internal static class CameraTest {
  private static readonly CameraIntrinsics fisheye =
      new CameraIntrinsics(CameraModel.KannalaBrandt4, 640, 480, 300, 310, 320, 240, 0.01, -0.002, 0.001, 0.0002);

  public static void PixelsAndBearingsGoThereAndBack() {
    Vector2d pixel;
    Vector3d bearing;
    Expect.True(fisheye.TryUnproject(new Vector2d(100.25, 50.5), out bearing), "unprojects");
    Expect.Near(new[] {1.0}, new[] {bearing.X * bearing.X + bearing.Y * bearing.Y + bearing.Z * bearing.Z}, 1e-12, "length");
    Expect.True(fisheye.TryProject(new Vector3d(2 * bearing.X, 2 * bearing.Y, 2 * bearing.Z), out pixel), "projects");
    Expect.Near(new[] {100.25, 50.5}, new[] {pixel.X, pixel.Y}, 1e-6, "pixel");
    Expect.True(!CameraIntrinsics.Pinhole(640, 480, 500, 500, 320, 240).TryProject(new Vector3d(0, 0, -1), out pixel), "behind");
  }

  public static void ParametersComeBack() {
    Expect.Numbers(new[] {300, 310, 320, 240, 0.01, -0.002, 0.001, 0.0002}, fisheye.Parameters(), "parameters");
    Expect.Equal(8u, fisheye.ParamCount, "count");
    fisheye.Check();
  }

  public static void WrongCamerasAreNamed() {
    CameraIntrinsics noSize = CameraIntrinsics.Pinhole(0, 480, 500, 500, 320, 240);
    Expect.Equal(Status.Argument, Expect.Throws<SpherecloudException>(noSize.Check, "width").Status, "status");
    Expect.Throws<SpherecloudException>(new CameraIntrinsics(CameraModel.Brown5, 640, 480, 1, 1, 1, 1).Check, "param_count");
    Expect.Throws<ArgumentException>(() => CameraIntrinsics.Pinhole(-1, 480, 500, 500, 320, 240), "-1 x 480");
    Expect.Throws<ArgumentException>(() => CameraIntrinsics.Pinhole(640, -480, 500, 500, 320, 240), "640 x -480");
    Expect.Throws<ArgumentException>(() => new CameraIntrinsics(CameraModel.Brown8, 1, 1, new double[13]), "12");
    Expect.Throws<ArgumentNullException>(() => new CameraIntrinsics(CameraModel.Brown8, 1, 1, null), "parameters");
  }

  public static void WrongRigsAreNamed() {
    Rig rig = Session.Rig();
    rig.Check();
    rig.ColorFromDepth.TranslationM.X = double.NaN;
    Expect.Throws<SpherecloudException>(rig.Check, "color_from_depth");
    Expect.Throws<SpherecloudException>(() => new Localizer(new LocalizerConfig { Rig = rig }), "color_from_depth");
    Expect.Throws<SpherecloudException>(() => new Aligner(new AlignerConfig { Rig = rig }), "color_from_depth");
    Expect.Throws<SpherecloudException>(new Rig().Check, "");
  }

  public static void TransformsCompose() {
    double half = Math.Sqrt(0.5);
    var bFromA = new Rigid(new Quaterniond(half, 0, 0, half), new Vector3d(1, 2, 3));  // a quarter turn about z
    Vector3d moved = bFromA.Apply(new Vector3d(1, 0, 0));
    Expect.Near(new double[] {1, 3, 3}, new[] {moved.X, moved.Y, moved.Z}, 1e-12, "point");
    Expect.Near(Session.Numbers(Rigid.Identity), Session.Numbers(bFromA * bFromA.Inverse()), 1e-12, "identity");
    var cFromB = new Rigid(Quaterniond.Identity, new Vector3d(0, 0, 1));
    Expect.Near(new double[] {half, 0, 0, half, 1, 2, 4}, Session.Numbers(cFromB * bFromA), 1e-12, "composed");
  }

  /// <summary>A comma is not both the decimal point and what stands between numbers.</summary>
  public static void NumbersAreWrittenAlikeInEveryCulture() {
    CultureInfo before = Thread.CurrentThread.CurrentCulture;
    Thread.CurrentThread.CurrentCulture = new CultureInfo("de-DE");
    try {
      var rigid = new Rigid(new Quaterniond(1, 0, 0, 0.5), new Vector3d(0.25, -2, 3));
      Expect.Equal("(1, 0, 0, 0.5) (0.25, -2, 3) m", rigid.ToString(), "rigid");
      Expect.Equal("(1.5, 2)", new Vector2d(1.5, 2).ToString(), "pixel");
    } finally {
      Thread.CurrentThread.CurrentCulture = before;
    }
  }
}
