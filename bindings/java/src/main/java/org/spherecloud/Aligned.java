package org.spherecloud;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.Objects;

/** Where an {@link Aligner} puts its images, of the colour camera's size, made once; the buffers are always the same. */
public final class Aligned extends Struct {
  private final int width;
  private final int height;
  private final ByteBuffer depth;
  private final ByteBuffer mask;
  private final ByteBuffer confidence;

  /** For aligners of this config. */
  public Aligned(AlignerConfig config) {
    this(Objects.requireNonNull(config, "config").getRig().getColorCamera());
  }

  private Aligned(Camera color) {
    this(color.getWidth(), color.getHeight());
  }

  /** For a colour camera of this size. */
  public Aligned(int width, int height) {
    super(Layout.ALIGNED_BYTES);
    if (!isSide(width) || !isSide(height)) {
      throw new IllegalArgumentException("No colour camera has images of " + width + " x " + height + "; give a width and"
          + " a height from " + Limits.CAMERA_MIN_PX + " to " + Limits.CAMERA_MAX_PX);
    }
    this.width = width;
    this.height = height;
    depth = image(2, Layout.ALIGNED_DEPTH, Layout.ALIGNED_DEPTH_STRIDE_BYTES);
    mask = image(1, Layout.ALIGNED_MASK, Layout.ALIGNED_MASK_STRIDE_BYTES);
    confidence = image(1, Layout.ALIGNED_CONFIDENCE, Layout.ALIGNED_CONFIDENCE_STRIDE_BYTES);
    putInt(Layout.ALIGNED_STRUCT_SIZE, Layout.ALIGNED_BYTES);
  }

  private static boolean isSide(int pixels) {
    return pixels >= Limits.CAMERA_MIN_PX && pixels <= Limits.CAMERA_MAX_PX;
  }

  private ByteBuffer image(int pixelBytes, int dataAt, int strideAt) {
    ByteBuffer image = ByteBuffer.allocateDirect(width * height * pixelBytes);
    putPointer(dataAt, Memory.address(image));
    putInt(strideAt, width * pixelBytes);
    return image.order(ByteOrder.nativeOrder());
  }

  /** In pixels. */
  public int getWidth() {
    return width;
  }

  /** In pixels. */
  public int getHeight() {
    return height;
  }

  /** Unsigned 16 bits a pixel in native order: z in the colour camera's frame, in units of alignedUnitM; 0: none. */
  public ByteBuffer getDepth() {
    return depth;
  }

  /** A byte a pixel: the value of an {@link AlignedPixel}. */
  public ByteBuffer getMask() {
    return mask;
  }

  /** A byte a pixel: 255 exact, 128 a relative error of 1 %, 51 of 2 %; 0 where there is no depth. */
  public ByteBuffer getConfidence() {
    return confidence;
  }
}
