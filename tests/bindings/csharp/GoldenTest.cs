using System;
using SphereCloud;

/// <summary>What C found, to the last bit.</summary>
internal static class GoldenTest {
  private static readonly string[] pose = {"q_w", "q_x", "q_y", "q_z", "t_x", "t_y", "t_z"};
  private delegate bool Player(Localizer localizer, LocalizerFrame frame, out LocalizerResult result);

  public static void WholeFramesAreThoseOfC() {
    Play(Process);
  }

  public static void FramesOnSeveralThreadsAreThoseOfC() {
    LocalizerConfig config = Session.Config();
    config.ParallelTasks = 3;
    Play(Process, config);
  }

  public static void HalvesOfFramesAreThoseOfC() {
    using (var features = new Features(Session.Config()))
      Play((Localizer localizer, LocalizerFrame frame, out LocalizerResult result) => {
        localizer.Extract(frame, features);
        frame.Color = default(ImageData);
        return localizer.Locate(frame, features, out result);
      });
  }

  public static void NativePointersAreReadToo() {
    Play((Localizer localizer, LocalizerFrame frame, out LocalizerResult result) => {
      Row row = Session.Frames[(int)frame.Sequence];
      byte[] color = Session.Bytes(row["color_file"]);
      IntPtr memory = System.Runtime.InteropServices.Marshal.AllocHGlobal(color.Length);
      System.Runtime.InteropServices.Marshal.Copy(color, 0, memory, color.Length);
      frame.Color = new ImageData(memory, 320, 240, PixelFormat.Gray8);
      var depth = new ushort[200 * 160];
      Buffer.BlockCopy(Session.Bytes(row["depth_file"]), 0, depth, 0, 2 * depth.Length);
      frame.Depth = new ImageData(depth, 200, 160);
      bool localized = localizer.Process(frame, out result);
      System.Runtime.InteropServices.Marshal.FreeHGlobal(memory);
      return localized;
    });
  }

  /// <summary>The next frame of the session, by a localizer that has seen those before; whether it was localized.</summary>
  internal static bool Compare(Localizer localizer, int index) {
    return Compare(localizer, Process, index);
  }

  private static bool Process(Localizer localizer, LocalizerFrame frame, out LocalizerResult result) {
    return localizer.Process(frame, out result);
  }

  private static void Play(Player player, LocalizerConfig config = null) {
    int localized = 0;
    using (Localizer localizer = Session.Localizer(config))
      for (int i = 0; i < Session.Frames.Count; ++i)
        if (Compare(localizer, player, i)) ++localized;
    Expect.True(localized >= 5 && localized < Session.Frames.Count, "the session has frames of both kinds");
  }

  private static bool Compare(Localizer localizer, Player player, int index) {
    Row row = Session.Frames[index];
    LocalizerResult result;
    bool localized = player(localizer, Session.Frame(index), out result);
    Expect.Equal(row.Whole("status") == (int)Status.Ok, localized, "status of frame " + index);
    Expect.Equal((uint)index, result.Sequence, "sequence");
    Expect.Equal(row.Whole("color_time_ns"), result.TimeNs, "time");
    Expect.Equal((LocalizerOutcome)row.Whole("outcome"), result.Outcome, "outcome");
    Expect.Equal((LocalizerState)row.Whole("state"), result.State, "state");
    Expect.Equal((uint)row.Whole("keypoints"), result.Keypoints, "keypoints");
    Expect.Equal((uint)row.Whole("inliers"), result.Inliers, "inliers");
    Expect.Numbers(new[] {row.Number("confidence")}, new[] {result.Confidence}, "confidence");
    Expect.Numbers(row.Numbers("", pose), Session.Numbers(result.CameraFromMap), "pose");
    Expect.Numbers(row.Numbers("covariance_", "0", "35"), new[] {result.Covariance[0, 0], result.Covariance[5, 5]}, "covariance");
    ComparePrediction(localizer, row);
    CompareConfidence(result);
    return localized;
  }

  /// <summary>A struct of C# is zeros before it is filled, and 0 is Localized.</summary>
  public static void AResultOfNoFrameSaysSo() {
    LocalizerResult result = default(LocalizerResult);
    Expect.True(!result.IsSet, "is set");
    Expect.Equal(0.0, result.ConfidenceWithin(1, 1), "confidence of no frame");
  }

  private static void ComparePrediction(Localizer localizer, Row row) {
    LocalizerPrediction prediction;
    bool known = localizer.Predict(row.Whole("color_time_ns") + 20000000, out prediction);
    Expect.Equal(row.Whole("predicted_status") == (int)Status.Ok, known, "status of the prediction");
    Expect.Numbers(row.Numbers("predicted_", pose), Session.Numbers(prediction.CameraFromMap), "prediction");
  }

  private static void CompareConfidence(LocalizerResult result) {
    double degrees5 = 5 * Math.PI / 180;
    Expect.Near(new[] {result.Confidence}, new[] {result.ConfidenceWithin(0.05, degrees5)}, 1e-9, "confidence of the usual bounds");
    Expect.True(result.IsSet, "is set");
    bool found = result.Outcome == LocalizerOutcome.Localized;
    Expect.Equal(found, result.ConfidenceWithin(1, 1) > result.ConfidenceWithin(0.001, 0.001), "confidence grows with the bounds");
    Expect.Equal(0.0, result.ConfidenceWithin(0, 1), "confidence of no bound");
  }
}
