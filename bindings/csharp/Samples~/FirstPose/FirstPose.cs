// From a map and the images of a frame to a pose.
//
//     FirstPose MAP COLOR DEPTH      COLOR: 320 x 240 bytes of grey; DEPTH: 200 x 160 numbers of 16 bits, millimetres
using System;
using System.IO;
using SphereCloud;

internal static class FirstPose {
  private static int Main(string[] files) {
    var color = CameraIntrinsics.Pinhole(320, 240, 250, 250, 160, 120);
    var depth = CameraIntrinsics.Pinhole(200, 160, 140, 140, 100, 80);
    var colorFromDepth = new Rigid(Quaterniond.Identity, new Vector3d(0.04, 0, 0));
    var config = new LocalizerConfig { Rig = new Rig(color, depth, colorFromDepth) };
    using (Map map = Map.Open(files[0]))
    using (var localizer = new Localizer(config)) {
      localizer.SetMap(0, map);
      var frame = new LocalizerFrame {
        Color = new ImageData(File.ReadAllBytes(files[1]), 320, 240, PixelFormat.Gray8),
        Depth = new ImageData(File.ReadAllBytes(files[2]), 200, 160, PixelFormat.Depth16)};
      bool localized = localizer.Process(frame, out LocalizerResult result);
      Console.WriteLine(localized ? "camera_from_map " + result.CameraFromMap : "no pose: " + result.Outcome + ", " + result.Hints);
      return localized ? 0 : 1;
    }
  }
}
