// How much longer a frame takes through the binding than through C: overhead.sh.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Runtime.InteropServices;
using SphereCloud;

internal static unsafe class Overhead {
  [DllImport("timed", CallingConvention = CallingConvention.Cdecl)]
  private static extern long timed_process(void* localizer, Native.sphc_localizer_frame* frame, LocalizerResult* result);

  private static int Main(string[] words) {
    int rounds = words.Length > 0 ? int.Parse(words[0]) : 100;
    LocalizerConfig config = Session.Config();
    config.Mode = LocalizerMode.Single;  // and no learning: the same work whenever a frame is looked at
    config.DepthOffsetSigmaM = config.DepthSlopeSigma = 0;
    config.Clock = null;
    double handingOver = 0;
    var ofC = new List<double>[Session.Frames.Count];
    var ofBinding = new List<double>[ofC.Length];
    using (Localizer localizer = Session.Localizer(config)) {
      handingOver = HandingOver(localizer, Session.Frame(8));
      for (int i = 0; i < ofC.Length; ++i) {
        ofC[i] = new List<double>();
        ofBinding[i] = new List<double>();
        Compare(localizer, Session.Frame(i), rounds, ofC[i], ofBinding[i]);
      }
    }
    Report(ofC, ofBinding, rounds, handingOver);
    return 0;
  }

  /// <summary>By turns, and each as often first.</summary>
  private static void Compare(Localizer localizer, LocalizerFrame frame, int rounds, List<double> ofC, List<double> ofBinding) {
    for (int round = -5; round < rounds; ++round) {
      double c = 0, binding = 0;
      for (int turn = 0; turn < 2; ++turn)
        if ((round + turn) % 2 == 0) c = C(localizer, frame);
        else binding = Binding(localizer, frame);
      if (round < 0) continue;  // warms up
      ofC.Add(c);
      ofBinding.Add(binding);
    }
  }

  /// <summary>What the binding does around the call, without the call.</summary>
  private static double HandingOver(Localizer localizer, LocalizerFrame frame) {
    const int Times = 200000;
    long* room = stackalloc long[LentFrame.Longs];
    long begin = Stopwatch.GetTimestamp();
    for (int i = 0; i < Times; ++i)
      using (var use = localizer.Handle.Enter(Lane.Main))
      using (var lent = new LentFrame(frame, room)) {}
    return (Stopwatch.GetTimestamp() - begin) * 1e6 / Stopwatch.Frequency / Times;
  }

  private static double C(Localizer localizer, LocalizerFrame frame) {
    long* room = stackalloc long[LentFrame.Longs];
    LocalizerResult result;
    using (var use = localizer.Handle.Enter(Lane.Main))
    using (var lent = new LentFrame(frame, room)) {
      long took = timed_process(use.Instance, lent.Raw, &result);
      Expect.True(took >= 0, "C failed");
      return took * 1e-3;
    }
  }

  private static double Binding(Localizer localizer, LocalizerFrame frame) {
    LocalizerResult result;
    long begin = Stopwatch.GetTimestamp();
    localizer.Process(frame, out result);
    return (Stopwatch.GetTimestamp() - begin) * 1e6 / Stopwatch.Frequency;
  }

  private static void Report(List<double>[] ofC, List<double>[] ofBinding, int rounds, double handingOver) {
    double c = 0, binding = 0;
    var more = new List<double>();
    for (int i = 0; i < ofC.Length; ++i) {
      c += Median(ofC[i]) / ofC.Length;
      binding += Median(ofBinding[i]) / ofC.Length;
      for (int j = 0; j < rounds; ++j) more.Add(ofBinding[i][j] - ofC[i][j]);
    }
    Console.WriteLine("frames,rounds,c_us,binding_us,ratio,median_difference_us,handing_over_us");
    Console.WriteLine(string.Join(",", ofC.Length, rounds, c.ToString("F1"), binding.ToString("F1"), (binding / c).ToString("F4"),
                                  Median(more).ToString("F2"), handingOver.ToString("F2")));
  }

  private static double Median(List<double> values) {
    var sorted = new List<double>(values);
    sorted.Sort();
    return sorted[sorted.Count / 2];
  }
}
