package org.spherecloud;

import java.nio.ByteBuffer;
import java.util.Objects;

/**
 * An image in a direct buffer of the caller's, which is read in place during calls.  It keeps the buffer object alive;
 * whoever made the buffer must not give its memory back before the call has returned.
 */
public final class Image extends ImageFields {
  private ByteBuffer data;
  private int first;

  /** No image yet. */
  public Image() {}

  Image(Struct whole, int at) {
    super(whole, at);
  }

  /**
   * An image whose rows lie one behind the other without gaps.
   *
   * @see #set(ByteBuffer, int, int, int, Format)
   */
  public void set(ByteBuffer data, int width, int height, Format format) {
    set(data, width, height, neededRow(width, height, format), format);
  }

  /**
   * The image that begins at the buffer's position.
   *
   * @param data direct; of several planes the first, such as Y of YUV_420_888; its position may change afterwards
   * @param strideBytes from a row to the next; the last row may end with its last pixel
   * @throws IllegalArgumentException the buffer is not direct, or too short; no image has this size, or this stride
   */
  public void set(ByteBuffer data, int width, int height, int strideBytes, Format format) {
    Objects.requireNonNull(data, "data");
    long needed = requiredBytes(width, height, strideBytes, format);
    if (!data.isDirect()) {
      throw new IllegalArgumentException("The image is in a heap buffer, which may move during a call; use"
          + " ByteBuffer.allocateDirect, or Image.directCopy(bytes) for an array");
    }
    if (data.remaining() < needed) {
      throw new IllegalArgumentException("The image needs " + needed + " bytes (" + width + " x " + height + ", stride "
          + strideBytes + ", " + format + ") and the buffer has " + data.remaining() + " from its position on");
    }
    this.data = data;
    first = data.position();
    putPointer(Layout.IMAGE_DATA, Memory.address(data) + first);
    putInt(Layout.IMAGE_WIDTH, width);
    putInt(Layout.IMAGE_HEIGHT, height);
    putInt(Layout.IMAGE_STRIDE_BYTES, strideBytes);
    putInt(Layout.IMAGE_FORMAT, format.value);
  }

  /** No image: as a camera that has none in a frame. */
  public void clear() {
    data = null;
    putPointer(Layout.IMAGE_DATA, 0);
  }

  /** A direct buffer with these bytes, for images that come as arrays.  Keep it, and put the next image into it. */
  public static ByteBuffer directCopy(byte[] bytes) {
    ByteBuffer copy = ByteBuffer.allocateDirect(Objects.requireNonNull(bytes, "bytes").length);
    copy.put(bytes).rewind();
    return copy;
  }

  /** Bytes of a row of so many pixels, the least stride; 0 where the format is not known or cannot have this width. */
  public static int rowBytes(Format format, int width) {
    Library.require();
    return Native.formatRowBytes(Objects.requireNonNull(format, "format").value, width);
  }

  private static long requiredBytes(int width, int height, int strideBytes, Format format) {
    int row = neededRow(width, height, format);
    if (strideBytes < row) {
      throw new IllegalArgumentException("The image has a stride of " + strideBytes + " bytes, and a row of " + width
          + " pixels " + format + " has " + row + "; give that or more");
    }
    return (long) strideBytes * (height - 1) + row;
  }

  private static int neededRow(int width, int height, Format format) {
    if (width <= 0 || height <= 0) {
      throw new IllegalArgumentException("No image is " + width + " x " + height + " pixels; give a width and a height"
          + " of 1 and more");
    }
    int row = rowBytes(format, width);
    if (row <= 0) {
      throw new IllegalArgumentException("No image of " + format + " is " + width + " pixels wide; where pixels share"
          + " bytes, give a multiple of as many as do");
    }
    return row;
  }

  /** Fails where the memory behind the buffer was given back, as by Image.close of Android. */
  void requireData() {
    if (data != null && data.limit() > first) data.get(first);
  }
}
