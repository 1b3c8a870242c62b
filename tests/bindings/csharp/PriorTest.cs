using SphereCloud;

/// <summary>What is known of a pose beforehand: a part counts once its method was called, or its flag is set.</summary>
internal static class PriorTest {
  private static readonly Vector3d up = new Vector3d(0, -1, 0);

  public static void MethodsSetValuesAndFlag() {
    var pose = new Rigid(Quaterniond.Identity, new Vector3d(1, 2, 3));
    var prior = new LocalizerPrior();
    Expect.Equal(PriorParts.None, prior.Flags, "parts at first");
    prior.SetPose(7, pose, 0.1, 0.2);
    Expect.Equal(PriorParts.Pose, prior.Flags, "parts");
    Expect.Numbers(Session.Numbers(pose), Session.Numbers(prior.CameraFromMap), "pose");
    Expect.Numbers(new[] {7, 0.1, 0.2}, new[] {prior.MapId, prior.RotationSigmaRad, prior.TranslationSigmaM}, "map and sigmas");
    prior.SetUp(8, up, new Vector3d(0, 0, 1), 0.3);
    Expect.Equal(PriorParts.Pose | PriorParts.Up, prior.Flags, "parts");
    Expect.Numbers(new[] {8, -1, 1, 0.3}, new[] {prior.MapId, prior.UpCamera.Y, prior.UpMap.Z, prior.UpSigmaRad}, "vertical");
    prior.SetOdometry(pose, 0.4, 0.5);
    Expect.Equal(PriorParts.Pose | PriorParts.Up | PriorParts.Odometry, prior.Flags, "parts");
    Expect.Numbers(Session.Numbers(pose), Session.Numbers(prior.OdometryFromCamera), "odometry");
    Expect.Numbers(new[] {0.4, 0.5}, new[] {prior.OdometryRotationSigmaRad, prior.OdometryTranslationSigmaM}, "sigmas");
  }

  public static void WhatIsSetCounts() {
    var negative = new LocalizerPrior();
    negative.SetPose(Session.MapId, Rigid.Identity, 0.1, -1);
    Refused(negative, "translation_sigma_m");
    var vague = new LocalizerPrior();
    vague.SetUp(Session.MapId, up, up, 2);
    Refused(vague, "up_sigma_rad");
    var still = new LocalizerPrior();
    still.SetOdometry(Rigid.Identity, 0, 0.01);
    Refused(still, "odometry_rotation_sigma_rad");
  }

  private static void Refused(LocalizerPrior prior, string words) {
    LocalizerFrame frame = Session.Frame(0);
    frame.Prior = prior;
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer())
      Expect.Throws<SpherecloudException>(() => localizer.Process(frame, out result), words);
  }
}
