using System;
using SphereCloud;

internal static class AlignerTest {
  private const int Width = 320, Height = 240;

  private static Aligner Made() {
    return new Aligner(new AlignerConfig { Rig = Session.Rig() });
  }

  public static void DepthIsSeenFromTheColourCamera() {
    var depth = new ushort[200 * 160];
    for (int i = 0; i < depth.Length; ++i) depth[i] = 2000;  // a wall
    var aligned = new ushort[Width * Height];
    var mask = new byte[aligned.Length];
    var confidence = new byte[aligned.Length];
    using (Aligner aligner = Made()) {
      aligner.Process(new ImageData(depth, 200, 160), aligned, mask, confidence);
      int center = Width * Height / 2 + Width / 2;
      Expect.Equal((ushort)2000, aligned[center], "depth");
      Expect.True((AlignedPixel)mask[center] == AlignedPixel.Measured || (AlignedPixel)mask[center] == AlignedPixel.Filled, "mask");
      Expect.True(confidence[center] > 128, "confidence");
      var again = new ushort[aligned.Length];
      aligner.Process(new ImageData(depth, 200, 160), again);
      for (int i = 0; i < again.Length; ++i) Expect.Equal(aligned[i], again[i], "pixel " + i);
      aligner.Process(new ImageData(depth, 200, 160), null, mask);
    }
  }

  public static void WhatDoesNotFitIsRefused() {
    Aligner aligner = Made();
    var depth = new ImageData(new ushort[200 * 160], 200, 160);
    Expect.Throws<ArgumentException>(() => aligner.Process(depth, new ushort[Width * Height - 1]), "320 x 240");
    Expect.Throws<ArgumentException>(() => aligner.Process(depth, null, new byte[3]), "320 x 240");
    Expect.Equal(Status.Image, Expect.Throws<SpherecloudException>(
        () => aligner.Process(new ImageData(new ushort[100 * 160], 100, 160), new ushort[Width * Height]), "").Status, "status");
    Expect.Throws<SpherecloudException>(() => aligner.Process(default(ImageData), new ushort[Width * Height]), "");
    aligner.Process(depth, new ushort[Width * Height]);
    aligner.Dispose();
    aligner.Dispose();
    Expect.Throws<ObjectDisposedException>(() => aligner.Process(depth, new ushort[Width * Height]), "Aligner");
  }
}
