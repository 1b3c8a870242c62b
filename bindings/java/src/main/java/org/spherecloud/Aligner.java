package org.spherecloud;

import java.lang.ref.Reference;
import java.util.Objects;

/** Depth images as seen from the colour camera.  One call at a time; a second one throws IllegalStateException. */
public final class Aligner implements AutoCloseable {
  private final Guard guard = new Guard("Aligner");
  private final Net net = new Net(this);
  private final int width;
  private final int height;
  private final long pointer;

  /**
   * Takes its memory here, once, and as long as some dozen images take.  The config is copied.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: the message names the field, cause and cure
   */
  public Aligner(AlignerConfig config) {
    Objects.requireNonNull(config, "config");
    width = config.getRig().getColorCamera().getWidth();
    height = config.getRig().getColorCamera().getHeight();
    try {
      pointer = make(config);
    } catch (Throwable failed) {
      net.release();
      throw failed;
    }
  }

  private long make(AlignerConfig config) {
    Struct need = new Struct(Layout.MEMORY_BYTES);
    Scratch scratch = Scratch.mine();
    Failure.check(Native.alignerMemory(config.address, need.address, scratch.messageAddress()), scratch);
    long bytes = need.getLong(Layout.MEMORY_STATE_BYTES);
    Block block = net.hold(new Block(bytes, need.getInt(Layout.MEMORY_ALIGNMENT)));
    Failure.check(Native.alignerInit(block.address, bytes, config.address, scratch.address(0), scratch.messageAddress()),
        scratch);
    Reference.reachabilityFence(config);
    block.holds(scratch.pointer(), Native::alignerFini);
    return scratch.pointer();
  }

  /**
   * Aligns one depth image, of config.depthFormat.  Makes no garbage.
   *
   * @throws SpherecloudException {@link Status#E_IMAGE}: the image does not fit the config
   * @throws IllegalArgumentException the aligned images are not of the colour camera's size
   */
  public void process(Image depth, Aligned aligned) {
    Objects.requireNonNull(depth, "depth");
    Objects.requireNonNull(aligned, "aligned");
    if (aligned.getWidth() != width || aligned.getHeight() != height) {
      throw new IllegalArgumentException("The aligned images are " + aligned.getWidth() + " x " + aligned.getHeight()
          + ", and the colour camera " + width + " x " + height);
    }
    guard.enter();
    try {
      depth.requireData();
      int status = Native.alignerProcess(pointer, depth.address, aligned.address);
      if (status < 0) throw Failure.of(status, Native.alignerMessage(pointer));
    } finally {
      guard.leave();
      Reference.reachabilityFence(depth);
      Reference.reachabilityFence(aligned);
      Reference.reachabilityFence(this);
    }
  }

  /** Gives its memory back.  A second time it does nothing. */
  @Override
  public void close() {
    if (guard.close()) net.release();
  }
}
