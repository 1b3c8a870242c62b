package org.spherecloud;

import java.lang.ref.Reference;
import java.util.Objects;

/**
 * What a colour image shows, between the two halves of a frame.  They are filled by {@link Localizer#extract} or
 * {@link #set}, and located by {@link Localizer#locate}, by several localizers at the same time if need be.
 */
public final class Features implements AutoCloseable {
  private final Guard guard = new Guard("Features");
  private final Net net = new Net(this);
  private final long pointer;

  /**
   * For localizers of this config.  Takes its memory here, once.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: the message names the field, cause and cure
   */
  public Features(LocalizerConfig config) {
    Objects.requireNonNull(config, "config");
    try {
      pointer = make(config);
    } catch (Throwable failed) {
      net.release();
      throw failed;
    }
  }

  private long make(LocalizerConfig config) {
    Struct need = new Struct(Layout.MEMORY_BYTES);
    Scratch scratch = Scratch.mine();
    Failure.check(Native.featuresMemory(config.address, need.address, scratch.messageAddress()), scratch);
    long bytes = need.getLong(Layout.MEMORY_STATE_BYTES);
    Block block = net.hold(new Block(bytes, need.getInt(Layout.MEMORY_ALIGNMENT)));
    Failure.check(Native.featuresInit(block.address, bytes, config.address, scratch.address(0),
        scratch.messageAddress()), scratch);
    Reference.reachabilityFence(config);
    block.holds(scratch.pointer(), Native::featuresFini);
    return scratch.pointer();
  }

  /**
   * Puts features of other hardware in, such as of an NPU.  Of the frame, the colour image and its time are read.
   *
   * @throws SpherecloudException a keypoint is beyond the limits, there are too many, or they are of another extractor;
   *     the features stay what they were
   */
  public void set(Frame frame, FeatureArrays arrays) {
    Objects.requireNonNull(frame, "frame").getColor().requireData();
    Objects.requireNonNull(arrays, "arrays");
    Struct told = arrays.told();
    enter();
    try {
      check(Native.featuresSet(pointer, frame.address, told.address));
    } finally {
      leave();
      Reference.reachabilityFence(frame);
      Reference.reachabilityFence(arrays);
      Reference.reachabilityFence(told);
    }
  }

  /**
   * Copies keypoints and descriptors out.
   *
   * @throws SpherecloudException {@link Status#E_STATE}: they are of no frame yet; {@link Status#E_CAPACITY}: the arrays
   *     are too small
   */
  public void get(FeatureArrays arrays) {
    Objects.requireNonNull(arrays, "arrays");
    Struct lent = new Struct(Layout.FEATURES_ARRAYS_BYTES);
    lent.putInt(Layout.FEATURES_ARRAYS_STRUCT_SIZE, Layout.FEATURES_ARRAYS_BYTES);
    enterShared();
    try {
      int status = Native.featuresGet(pointer, lent.address);
      if (status < 0) throw Failure.of(status, "The features are of no frame yet; extract or set them first");
      arrays.take(lent);
    } finally {
      leaveShared();
      Reference.reachabilityFence(lent);
    }
  }

  /** For a call that writes them. */
  long enter() {
    guard.enter();
    return pointer;
  }

  void leave() {
    guard.leave();
    Reference.reachabilityFence(this);
  }

  /** For a call that reads them. */
  long enterShared() {
    guard.enterShared();
    return pointer;
  }

  void leaveShared() {
    guard.leaveShared();
    Reference.reachabilityFence(this);
  }

  /** Of a call that wrote them. */
  void check(int status) {
    if (status < 0) throw Failure.of(status, Native.featuresMessage(pointer));
  }

  /** Gives the memory back.  A second time it does nothing. */
  @Override
  public void close() {
    if (guard.close()) net.release();
  }
}
