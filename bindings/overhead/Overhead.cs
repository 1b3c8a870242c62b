// What overhead.c does, through the C# binding: a line in, a line with processor times out.
//
//     Overhead FOLDER
using System;
using System.IO;
using System.Runtime.InteropServices;
using SphereCloud;

internal static class Overhead {
  private const int Frames = 10, Predictions = 1000, ThreadCpuTime = 3;

  private struct Time {
    internal long Seconds, Nanoseconds;
  }

  [DllImport("libc")]
  private static extern int clock_gettime(int clock, out Time now);

  private static long UsedNs() {
    clock_gettime(ThreadCpuTime, out Time now);
    return now.Seconds * 1000000000 + now.Nanoseconds;
  }

  private static LocalizerConfig Config() {
    var color = CameraIntrinsics.Pinhole(320, 240, 250, 250, 160, 120);
    var depth = CameraIntrinsics.Pinhole(200, 160, 140, 140, 100, 80);
    return new LocalizerConfig { Rig = new Rig(color, depth, new Rigid(Quaterniond.Identity, new Vector3d(0.04, 0, 0))) };
  }

  private static byte[][] Images(string folder, string name) {
    var images = new byte[Frames][];
    for (int i = 0; i < Frames; ++i) images[i] = File.ReadAllBytes(Path.Combine(folder, string.Format(name, i)));
    return images;
  }

  private static void Play(Localizer localizer, byte[][] color, byte[][] depth) {
    var times = new string[Frames + 1];
    long timeNs = 0;
    localizer.Reset();
    for (int i = 0; i < Frames; ++i) {
      long before = UsedNs();
      timeNs = 1000000000L + 33000000L * i;
      var frame = new LocalizerFrame {
        ColorTimeNs = timeNs, Color = new ImageData(color[i], 320, 240, PixelFormat.Gray8),
        DepthTimeNs = timeNs, Depth = new ImageData(depth[i], 200, 160, PixelFormat.Depth16)};
      localizer.Process(frame, out LocalizerResult result);
      times[i] = (UsedNs() - before).ToString();
    }
    long first = UsedNs();
    for (int i = 0; i < Predictions; ++i) localizer.Predict(timeNs + i, out LocalizerPrediction prediction);
    times[Frames] = ((UsedNs() - first) / Predictions).ToString();
    Console.WriteLine(string.Join(" ", times));
  }

  private static void Main(string[] words) {
    byte[][] color = Images(words[0], "color_{0:00}.gray8"), depth = Images(words[0], "depth_{0:00}.depth16");
    using (Map map = Map.Open(Path.Combine(words[0], "room.sphc")))
    using (var localizer = new Localizer(Config())) {
      localizer.SetMap(0, map);
      while (Console.ReadLine() != null) Play(localizer, color, depth);
    }
  }
}
