using System;
using SphereCloud;

/// <summary>A second depth camera of a rig, and the first as it is in a frame.</summary>
internal static class DepthCameraTest {
  private static readonly ushort[] blind = new ushort[200 * 160];

  /// <summary>A rig whose second depth camera is as the first.</summary>
  private static LocalizerConfig Config() {
    LocalizerConfig config = Session.Config();
    config.DepthCameras.Add(
        new LocalizerDepthCamera { Camera = config.Rig.DepthCamera, ColorFromDepth = config.Rig.ColorFromDepth });
    return config;
  }

  /// <summary>The first depth camera is blind, and the second sees what it saw.</summary>
  private static LocalizerFrame Frame() {
    LocalizerFrame frame = Session.Frame(0);
    frame.DepthViews.Add(new LocalizerDepthView { TimeNs = frame.DepthTimeNs, Depth = frame.Depth });
    frame.Depth = new ImageData(blind, 200, 160);
    return frame;
  }

  private static void Refused(Localizer localizer, LocalizerFrame frame, string words) {
    LocalizerResult result;
    Expect.Throws<SpherecloudException>(() => localizer.Process(frame, out result), words);
  }

  public static void TheSecondSeesWhereTheFirstIsBlind() {
    LocalizerConfig config = Config();
    LocalizerFrame frame = Frame();
    LocalizerDepthView view = frame.DepthViews[0];
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer(config)) {
      Expect.True(localizer.Process(frame, out result), "localizes");
      view.Camera = config.Rig.DepthCamera;
      view.ColorFromDepth = config.Rig.ColorFromDepth;
      ++frame.ColorTimeNs;
      Expect.True(localizer.Process(frame, out result), "localizes with the cameras of the frame");
      view.Camera = config.Rig.ColorCamera;
      Refused(localizer, frame, "frame.depth_views[i].camera");
      view.Camera = null;
      view.ColorFromDepth = new Rigid(Quaterniond.Identity, new Vector3d(double.NaN, 0, 0));
      Refused(localizer, frame, "color_from_depth");
      view.ColorFromDepth = null;
      view.Depth = default(ImageData);
      ++frame.ColorTimeNs;
      Expect.True(!localizer.Process(frame, out result), "localizes without depth");
    }
  }

  public static void DepthViewsThatDoNotFitAreRefused() {
    LocalizerConfig config = Config();
    LocalizerFrame frame = Frame();
    using (Localizer localizer = Session.Localizer(config)) {
      frame.DepthViews[0].Depth = new ImageData(blind, 200, 159);
      Refused(localizer, frame, "159");
      Refused(localizer, Session.Frame(0), "frame.depth_view_count is 0");
    }
    config.DepthCameras[0].AmplitudeMin = 10;
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer(config)) {
      Refused(localizer, Frame(), "amplitude");
      frame = Frame();
      frame.DepthViews[0].Amplitude = new ImageData(new byte[200 * 160], 200, 160, PixelFormat.Gray8);
      Expect.True(!localizer.Process(frame, out result), "believes faint depth");
    }
  }

  public static void MoreThanTwoAreRefused() {
    LocalizerConfig config = Config();
    config.DepthCameras.Add(new LocalizerDepthCamera());
    Expect.Throws<ArgumentException>(() => new Localizer(config), "at most 1");
    LocalizerFrame frame = Frame();
    frame.DepthViews.Add(new LocalizerDepthView());
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer())
      Expect.Throws<ArgumentException>(() => localizer.Process(frame, out result), "at most 1");
  }

  /// <summary>What is lent for a call lies apart.</summary>
  public static void ItGoesWithFurtherCameras() {
    LocalizerConfig config = Config();
    LocalizerFrame frame = Frame();
    config.MaxKeypoints *= Limits.CamerasMax;
    for (int i = 0; i < Limits.CamerasMax - 1; ++i) {
      config.Cameras.Add(new LocalizerCamera { Camera = config.Rig.ColorCamera });
      frame.Views.Add(new LocalizerView {
        TimeNs = frame.ColorTimeNs, Image = frame.Color, Camera = config.Rig.ColorCamera, ColorFromCamera = Rigid.Identity});
    }
    frame.DepthViews[0].Camera = config.Rig.DepthCamera;
    frame.DepthViews[0].ColorFromDepth = config.Rig.ColorFromDepth;
    frame.DepthViews[0].Amplitude = new ImageData(new byte[200 * 160], 200, 160, PixelFormat.Gray8);
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer(config)) {
      bool localized = localizer.Process(frame, out result);
      Expect.True(localized, "no pose: " + result.Outcome);
    }
  }

  public static void DefaultsAreThoseOfTheConfig() {
    var config = new LocalizerConfig();
    var camera = new LocalizerDepthCamera();
    Expect.Numbers(new[] {0.001, config.DepthMinM, config.DepthMaxM, config.DepthSigmaM},
                   new[] {camera.UnitM, camera.MinM, camera.MaxM, camera.SigmaM}, "defaults");
  }

  public static void TheFirstAsItIsInAFrame() {
    LocalizerFrame frame = Session.Frame(0);
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer()) {
      frame.DepthCamera = Session.Rig().DepthCamera;
      Expect.True(localizer.Process(frame, out result), "localizes");
      frame.DepthCamera = Session.Rig().ColorCamera;
      Refused(localizer, frame, "frame.depth_camera");
    }
  }
}
