using System;

namespace SphereCloud {
/// <summary>What format, size, stride and element of an array can be together.</summary>
internal static class ImageShape {
  /// <summary>Gives the bytes of a row. A stride of 0 is that of rows that follow each other closely.</summary>
  internal static int RequireRow(PixelFormat format, int width, int height, int strideBytes) {
    if (width < 1 || height < 1)
      throw new ArgumentException("an image is " + width + " x " + height + " pixels; give a width and a height of 1 or more");
    int row = Library.RowBytes(format, width);
    if (row == 0 || row > Native.StrideMaxBytes) throw NoRow(format, width);
    if (strideBytes != 0 && (strideBytes < row || strideBytes > Native.StrideMaxBytes))
      throw new ArgumentException("the stride is " + strideBytes + " bytes; " + width + " pixels " + format + " need " + row +
                                  " to " + Native.StrideMaxBytes + ", or 0 where rows follow each other closely");
    return row;
  }

  private static ArgumentException NoRow(PixelFormat format, int width) {
    if (Library.RowBytes(format, 4) == 0)  // a width that every format can have
      return new ArgumentException(
          "the library " + Library.Version + " knows no format " + format + "; give one of PixelFormat");
    return new ArgumentException(
        "no row of " + format + " has " + width + " pixels; give a width of at most " + Native.StrideMaxBytes + " bytes, " +
        "of formats whose pixels share bytes an even one, or a multiple of 4 for 10 bits");
  }

  /// <summary>Arrays of bytes hold any format; those of wider elements hold formats whose pixels are such elements.</summary>
  internal static void RequireElements(PixelFormat format, int elementBytes) {
    int wanted = ElementBytes(format);
    if (wanted != elementBytes)
      throw new ArgumentException("a " + ArrayOf(elementBytes) + " holds no pixels " + format + "; give a " + ArrayOf(wanted) +
                                  ", or the format that the array has");
  }

  private static int ElementBytes(PixelFormat format) {
    if (format == PixelFormat.DepthF32 || format == PixelFormat.RangeF32) return 4;
    return Native.sphc_format_bytes(format) == 2 ? 2 : 1;
  }

  private static string ArrayOf(int elementBytes) {
    return elementBytes == 4 ? "float[]" : elementBytes == 2 ? "ushort[]" : "byte[]";
  }
}
}
