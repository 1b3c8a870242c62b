using System;
using SphereCloud;

/// <summary>Images that cannot be are refused where they are made, with what to give instead.</summary>
internal static class ImageTest {
  private static readonly Array formats = Enum.GetValues(typeof(PixelFormat));

  private static bool Taken(Func<ImageData> make) {
    try {
      return make().IsSet;
    } catch (ArgumentException) {
      return false;
    }
  }

  /// <summary>4 x 4 pixels of every format, in arrays that are large enough for any.</summary>
  public static void ElementsFitTheFormat() {
    foreach (PixelFormat format in formats) {
      bool isFloat = format.ToString().EndsWith("F32"), isWide = Library.RowBytes(format, 4) == 8;
      Expect.True(Taken(() => new ImageData(new byte[99], 4, 4, format)), format + " in bytes");
      Expect.Equal(isFloat, Taken(() => new ImageData(new float[99], 4, 4, format)), format + " in floats");
      Expect.Equal(isWide, Taken(() => new ImageData(new ushort[99], 4, 4, format)), format + " in 16 bits");
    }
    Expect.Throws<ArgumentException>(() => new ImageData(new float[99], 4, 4, PixelFormat.Depth16), "give a ushort[]");
    Expect.Throws<ArgumentException>(() => new ImageData(new ushort[99], 4, 4, PixelFormat.DepthF32), "give a float[]");
    Expect.Throws<ArgumentException>(() => new ImageData(new ushort[99], 4, 4, PixelFormat.Gray8), "give a byte[]");
    Expect.Throws<ArgumentException>(() => new ImageData(new ushort[99], 4, 4, PixelFormat.Depth12p), "give a byte[]");
  }

  public static void UnknownFormatsAreNamed() {
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], 2, 2, 0), "format 0");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], 2, 2, (PixelFormat)99), "format 99");
    Expect.Throws<ArgumentException>(() => new ImageData(new ushort[10], 2, 2, (PixelFormat)99), "format 99");
    Expect.Throws<ArgumentException>(() => new ImageData((IntPtr)64, 2, 2, (PixelFormat)99), "PixelFormat");
  }

  public static void SizesThatCannotBeAreNamed() {
    foreach (int size in new[] {0, -1, int.MinValue}) {
      Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], size, 2, PixelFormat.Gray8), size + " x 2");
      Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], 2, size, PixelFormat.Gray8), "2 x " + size);
    }
    foreach (PixelFormat format in formats)
      foreach (int width in new[] {int.MaxValue, int.MaxValue - 3, 1431655765})  // the last times three is nearly 2^32
        Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], width, 1, format), width + " pixels");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], 2, int.MaxValue, PixelFormat.Gray8), "the array has 10");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[99], 5, 2, PixelFormat.Gray12p), "an even one");
    Expect.Equal(0, Library.RowBytes(PixelFormat.Rgb8, 1431655765), "bytes of a row beyond what an int holds");
  }

  public static void StridesThatCannotBeAreNamed() {
    foreach (int stride in new[] {1, 9, -10, Native.StrideMaxBytes + 1})
      Expect.Throws<ArgumentException>(
          () => new ImageData(new byte[999], 10, 2, PixelFormat.Gray8, stride), "need 10 to 1048576");
    var room = new byte[2 * Native.StrideMaxBytes];
    Expect.True(Taken(() => new ImageData(room, 10, 2, PixelFormat.Gray8, Native.StrideMaxBytes)), "the largest");
  }
}
