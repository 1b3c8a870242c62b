using System;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Where the pixels of an image are. Nothing is copied: a call reads the pixels where they lie, and an array
/// cannot move until the call returns. The default value is no image.</summary>
public readonly unsafe struct ImageData {
  private readonly Array array;
  private readonly IntPtr data;  // in the array: an offset
  private readonly int width, height, stride;
  private readonly PixelFormat format;

  /// <summary>Pixels in bytes. A stride of 0 means that rows follow each other closely. Throws ArgumentException where
  /// the array is too small, and where no image has that format, size and stride.</summary>
  public ImageData(byte[] pixels, int width, int height, PixelFormat format, int strideBytes = 0, int offsetBytes = 0)
      : this(pixels, 1, IntPtr.Zero + offsetBytes, width, height, format, strideBytes) {}

  /// <summary>Pixels of 16 bits, such as depth in millimetres. As the constructor for bytes; the format is one of 2 bytes a
  /// pixel.</summary>
  public ImageData(ushort[] pixels, int width, int height, PixelFormat format = PixelFormat.Depth16, int strideBytes = 0)
      : this(pixels, 2, IntPtr.Zero, width, height, format, strideBytes) {}

  /// <summary>Pixels that are floats, such as depth in metres. As the constructor for bytes; the format is DepthF32 or
  /// RangeF32.</summary>
  public ImageData(float[] pixels, int width, int height, PixelFormat format = PixelFormat.DepthF32, int strideBytes = 0)
      : this(pixels, 4, IntPtr.Zero, width, height, format, strideBytes) {}

  /// <summary>Pixels in native memory, which the caller keeps until the call returns: in Unity, the pointer of
  /// NativeArrayUnsafeUtility.GetUnsafeReadOnlyPtr. Its extent cannot be checked; format, size and stride are.</summary>
  public ImageData(IntPtr pixels, int width, int height, PixelFormat format, int strideBytes = 0)
      : this(null, 0, pixels, width, height, format, strideBytes) {}

  private ImageData(Array array, int elementBytes, IntPtr data, int width, int height, PixelFormat format, int strideBytes) {
    if (array == null && elementBytes != 0) throw new ArgumentNullException("pixels");
    int rowBytes = ImageShape.RequireRow(format, width, height, strideBytes);
    if (elementBytes > 1) ImageShape.RequireElements(format, elementBytes);
    this.array = array;
    this.data = data;
    this.width = width;
    this.height = height;
    this.format = format;
    stride = strideBytes != 0 ? strideBytes : rowBytes;
    if (array != null) RequireRoom((long)elementBytes * array.Length, (long)data, rowBytes);
  }

  /// <summary>True where there are pixels.</summary>
  public bool IsSet { get { return array != null || data != IntPtr.Zero; } }

  private void RequireRoom(long bytes, long offset, int rowBytes) {
    long needed = offset + (long)stride * (height - 1) + rowBytes;
    if (offset < 0 || needed > bytes)
      throw new ArgumentException("an image of " + width + " x " + height + " pixels " + format + ", " + stride +
                                  " bytes a row from byte " + offset + " on, needs " + needed + " bytes; the array has " + bytes);
  }

  /// <summary>For one call. What is pinned is to be freed: an array's handle, or default.</summary>
  internal GCHandle Lend(Native.sphc_image* image) {
    GCHandle pin = array != null ? GCHandle.Alloc(array, GCHandleType.Pinned) : default(GCHandle);
    image->data = array != null ? (byte*)pin.AddrOfPinnedObject() + (long)data : (void*)data;
    image->width = (uint)width;
    image->height = (uint)height;
    image->stride_bytes = (uint)stride;
    image->format = format;
    return pin;
  }
}
}
