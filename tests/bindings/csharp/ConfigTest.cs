using System;
using System.Collections.Generic;
using SphereCloud;

/// <summary>What a localizer is told, and tells.</summary>
internal static class ConfigTest {
  public static void TheLibraryIsThatOfTheHeader() {
    Expect.Equal(Native.Version, Library.Version, "version");
    Expect.Equal(null, Library.VersionProblem(Native.Abi, Native.Version), "problem of the same version");
    Expect.True(Library.VersionProblem(Native.Abi + 1, Native.Version).Message.Contains("one release"), "another ABI");
    Expect.Equal(null, Library.VersionProblem(Native.Abi, "1.99.0"), "problem of a newer version");
    Expect.True(Library.VersionProblem(0, "0.2.0").Message.Contains("0.2.0"), "no ABI");
  }

  public static unsafe void ConstantsHaveTheNamesThatTheLibraryGives() {
    foreach (Status value in Enum.GetValues(typeof(Status)))
      Named("SPHC" + (value < 0 ? "E" : "") + value, Text.Of(Native.sphc_status_name(value)));
    foreach (PixelFormat value in Enum.GetValues(typeof(PixelFormat)))
      Named("SPHCFORMAT" + value, Text.Of(Native.sphc_format_name(value)));
    foreach (Faults value in Enum.GetValues(typeof(Faults)))
      if (value != Faults.None) Named("SPHCFAULT" + value, Text.Of(Native.sphc_localizer_fault_name((uint)value)));
    foreach (LocalizerOutcome value in Enum.GetValues(typeof(LocalizerOutcome)))
      Named("SPHCOUTCOME" + value, Text.Of(Native.sphc_localizer_outcome_name(value)));
  }

  private static void Named(string ours, string ofTheLibrary) {
    Expect.Equal(ofTheLibrary.Replace("_", ""), ours.ToUpperInvariant(), "name");
  }

  public static void DefaultsAreThoseOfTheLibrary() {
    var config = new LocalizerConfig();
    Expect.True(config.MaxKeypoints > 0 && config.DepthMaxM > config.DepthMinM, "defaults");
    Expect.Numbers(Session.Numbers(Rigid.Identity), Session.Numbers(config.Rig.ColorFromDepth), "color_from_depth");
    Expect.Numbers(Session.Numbers(Rigid.Identity), Session.Numbers(new LocalizerPrior().CameraFromMap), "prior");
    Expect.Equal(0.001, config.Rig.DepthUnitM, "unit");
  }

  public static void TheLogIsHeard() {
    var lines = new List<string>();
    LocalizerConfig config = Session.Config();
    config.LogLevel = LogLevel.Debug;
    config.Log = (level, text) => lines.Add(level + ": " + text);
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer(config)) localizer.Process(Session.Frame(0), out result);
    Expect.True(lines.Count > 0 && lines[lines.Count - 1].StartsWith("Debug: "), "no line");
  }

  public static void WhatTheLogThrowsComesOutOfTheCall() {
    LocalizerConfig config = Session.Config();
    config.LogLevel = LogLevel.Debug;
    bool armed = false;
    config.Log = (level, text) => { if (armed) throw new InvalidOperationException("from the log"); };
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer(config)) {
      armed = true;
      Expect.Throws<InvalidOperationException>(() => localizer.Process(Session.Frame(0), out result), "from the log");
      armed = false;
      Expect.True(localizer.Process(Session.Frame(1), out result), "goes on");
    }
  }

  public static void TheClockTimesStages() {
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer()) localizer.Process(Session.Frame(0), out result);
    Expect.True(result.FeaturesUs > 0 && result.FeaturesUs < 10000000, "takes " + result.FeaturesUs + " us");
    LocalizerConfig config = Session.Config();
    config.Clock = null;
    using (Localizer localizer = Session.Localizer(config)) {
      localizer.Process(Session.Frame(0), out result);
      Expect.Equal(0u, result.FeaturesUs, "time without a clock");
      LocalizerFrame frame = Session.Frame(1);
      frame.DeadlineUs = 1000;
      Expect.Throws<SpherecloudException>(() => localizer.Process(frame, out result), "clock");
    }
  }

  public static void ADeadlineCuts() {
    LocalizerFrame frame = Session.Frame(0);
    frame.DeadlineUs = 1;
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer()) localizer.Process(frame, out result);
    Expect.True(result.Cuts != Cuts.None, "nothing was cut");
  }

  public static void MapsComeAndGo() {
    LocalizerResult result;
    using (Map map = Map.FromBytes(Session.Bytes("room.sphc")))
    using (var localizer = new Localizer(Session.Config())) {
      Expect.Equal(0, localizer.MapCount, "maps");
      Expect.True(!localizer.Process(Session.Frame(0), out result), "localizes without a map");
      localizer.SetMap(3, map);
      localizer.SetMap(3, map);
      Expect.Equal(1, localizer.MapCount, "maps");
      localizer.SetMapTransform(3, Rigid.Identity, 0.01, 0.02);
      localizer.SetMapTransform(3, null);
      Expect.True(localizer.Process(Session.Frame(1), out result), "localizes");
      Expect.Equal(3u, result.MapId, "map");
      localizer.RemoveMap(3);
      Expect.Throws<SpherecloudException>(() => localizer.RemoveMap(3), "");
      Expect.Throws<SpherecloudException>(() => localizer.SetMapTransform(3, Rigid.Identity), "");
    }
  }

  public static void MapsTellWhatTheyAre() {
    using (Map map = Map.Open(Session.MapPath)) {
      MapInfo info = map.Info;
      Expect.True(info.PointCount > 100, "points");
      Expect.Equal((ulong)Session.Bytes("room.sphc").Length, info.FileBytes, "bytes");
      Expect.Equal(32, info.BuildName.Length, "name");
      Vector3d d = map.Direction((int)info.PointCount - 1);
      Expect.Near(new[] {1.0}, new[] {d.X * d.X + d.Y * d.Y + d.Z * d.Z}, 1e-6, "length of a direction");
      foreach (int index in new[] {-1, (int)info.PointCount})
        Expect.Throws<SpherecloudException>(() => map.Direction(index), "pointIndex is " + index + "; give 0 to " + (info.PointCount - 1));
    }
  }

  public static void ParametersHaveRanges() {
    using (Localizer localizer = Session.Localizer()) {
      LocalizerParameterRange range = Localizer.ParameterRange(LocalizerParameter.MinInliers);
      Expect.True(range.Whole && range.Lowest <= range.Initial && range.Initial <= range.Highest, "range");
      Expect.Equal(range.Initial, localizer.GetParameter(LocalizerParameter.MinInliers), "parameter");
      localizer.SetParameter(LocalizerParameter.MinInliers, range.Highest);
      Expect.Equal(range.Highest, localizer.GetParameter(LocalizerParameter.MinInliers), "parameter");
      Expect.Throws<SpherecloudException>(() => localizer.SetParameter(LocalizerParameter.MinInliers, range.Highest + 1), "MIN_INLIERS");
      foreach (Action read in new Action[] {() => localizer.GetParameter((LocalizerParameter)99),
                                            () => Localizer.ParameterRange((LocalizerParameter)99)}) {
        var unknown = Expect.Throws<SpherecloudException>(read, "no parameter 99; give one of LocalizerParameter");
        Expect.Equal(Status.Unsupported, unknown.Status, "status");
        Expect.True(!unknown.Message.Contains("MIN_INLIERS"), "words about another call");
      }
    }
  }

  public static void DepthBiasGoesOn() {
    LocalizerResult result;
    using (Localizer first = Session.Localizer(), second = Session.Localizer()) {
      first.Process(Session.Frame(0), out result);
      first.Process(Session.Frame(1), out result);
      second.SetDepthBias(result.Depth);
      DepthBias learnt = result.Depth;
      second.Process(Session.Frame(2), out result);
      Expect.True(result.Depth.OffsetSigmaM <= learnt.OffsetSigmaM * 1.5, "what was learnt");
      learnt.Slope = double.NaN;
      Expect.Throws<SpherecloudException>(() => second.SetDepthBias(learnt), "");
      second.Reset();
      second.Process(Session.Frame(3), out result);
      Expect.Equal(PoseEvents.Relocalized, result.Events, "events");
    }
  }

  public static void ObservationsAndHypothesesAreTold() {
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer()) {
      Expect.Equal(0, localizer.Observations().Length, "observations before a frame");
      localizer.Process(Session.Frame(0), out result);
      LocalizerObservation[] observations = localizer.Observations();
      Expect.Equal((int)result.Keypoints, observations.Length, "observations");
      int inliers = Array.FindAll(observations, o => (o.Flags & ObservationFlags.Inlier) != 0).Length;
      Expect.Equal((int)result.Inliers, inliers, "inliers");
      var few = new LocalizerObservation[3];
      Expect.Equal(observations.Length, localizer.Observations(few), "how many there are");
      Expect.Equal(observations[2].XPx, few[2].XPx, "third");
      LocalizerHypothesis[] hypotheses = localizer.Hypotheses();
      Expect.True(hypotheses.Length >= 1 && hypotheses[0].IsResult, "hypotheses");
      Expect.Numbers(Session.Numbers(result.CameraFromMap), Session.Numbers(hypotheses[0].CameraFromMap), "pose");
    }
  }

  /// <summary>A second camera, where the colour camera is and with its image.</summary>
  public static void FurtherCamerasAreSeen() {
    LocalizerConfig config = Session.Config();
    config.Cameras.Add(new LocalizerCamera { Camera = config.Rig.ColorCamera });
    LocalizerFrame frame = Session.Frame(0);
    LocalizerResult result;
    using (Localizer localizer = Session.Localizer(config)) {
      Expect.Throws<SpherecloudException>(() => localizer.Process(frame, out result), "view");
      frame.Views.Add(new LocalizerView {
        TimeNs = frame.ColorTimeNs, Image = frame.Color, Camera = config.Rig.ColorCamera, ColorFromCamera = Rigid.Identity});
      frame.ColorCamera = config.Rig.ColorCamera;
      frame.ColorFromDepth = config.Rig.ColorFromDepth;
      Expect.True(localizer.Process(frame, out result), "localizes");
      Expect.True(Array.Exists(localizer.Observations(), o => o.Camera == 1), "nothing of the second camera");
    }
    for (int i = 0; i < 7; ++i) config.Cameras.Add(new LocalizerCamera());
    Expect.Throws<ArgumentException>(() => new Localizer(config), "at most 7");
    for (int i = 0; i < 7; ++i) frame.Views.Add(new LocalizerView());
    using (Localizer localizer = Session.Localizer())
      Expect.Throws<ArgumentException>(() => localizer.Process(frame, out result), "at most 7");
  }

  public static void MemoryIsAccountedFor() {
    long bytes = 0;
    foreach (MemoryPiece piece in Session.Config().MemoryPieces()) {
      Expect.True(piece.Name.Length > 0, "name");
      bytes += piece.Bytes;
    }
    Expect.True(bytes > 1000000, bytes + " bytes");
  }
}
