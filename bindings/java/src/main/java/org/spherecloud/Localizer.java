package org.spherecloud;

import java.lang.ref.Reference;
import java.util.HashMap;
import java.util.Map;
import java.util.Objects;

/**
 * Answers where the colour camera is in a map.  It takes its memory when it is made, and {@link #process} makes no
 * garbage.  One call at a time; a second one at the same time throws IllegalStateException, as every call after
 * {@link #close} does.  Only {@link #extract} may run beside other calls than process, extract and close.
 */
public final class Localizer implements AutoCloseable {
  private final Guard guard = new Guard("Localizer");
  private final Guard extraction = new Guard("Localizer");
  private final Net net = new Net(this);
  private final Map<Integer, Block> maps = new HashMap<>();
  private final long pointer;

  /**
   * Takes its memory here, once.  The config is copied.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: the message names the field, cause and cure
   */
  public Localizer(LocalizerConfig config) {
    Objects.requireNonNull(config, "config");
    try {
      pointer = make(config);
    } catch (Throwable failed) {
      net.release();
      throw failed;
    }
  }

  /** With one map, whose id is 0. */
  public Localizer(LocalizerConfig config, SphereMap map) {
    this(config);
    try {
      setMap(0, map);
    } catch (Throwable failed) {
      close();
      throw failed;
    }
  }

  private long make(LocalizerConfig config) {
    Struct need = new Struct(Layout.MEMORY_BYTES);
    Scratch scratch = new Scratch(); // not the thread's, which the log may use meanwhile
    Failure.check(Native.localizerMemory(config.address, need.address, scratch.messageAddress()), scratch);
    long stateBytes = need.getLong(Layout.MEMORY_STATE_BYTES);
    long scratchBytes = need.getLong(Layout.MEMORY_SCRATCH_BYTES);
    int alignment = need.getInt(Layout.MEMORY_ALIGNMENT);
    Block state = net.hold(new Block(stateBytes, alignment));
    Block room = net.hold(new Block(scratchBytes, alignment));
    Struct told = config.told(net);
    Failure.check(Native.localizerInit(state.address, stateBytes, room.address, scratchBytes, told.address,
        scratch.address(0), scratch.messageAddress()), scratch);
    Reference.reachabilityFence(told);
    Reference.reachabilityFence(config);
    state.holds(scratch.pointer(), Native::localizerFini);
    return scratch.pointer();
  }

  /**
   * Adds the map, or replaces the one of this id by a newer release of the same place.  The localizer keeps what it
   * needs of the map, which may be closed afterwards.
   *
   * @throws SpherecloudException {@link Status#E_CAPACITY}: config.maxMaps are there; {@link Status#E_ARGUMENT}: the map
   *     is of another band
   */
  public void setMap(int mapId, SphereMap map) {
    Objects.requireNonNull(map, "map");
    enter();
    try {
      map.lend((mapPointer, block) -> {
        check(Native.localizerSetMap(pointer, mapId, mapPointer));
        Block before = maps.put(mapId, net.hold(block.retain()));
        if (before != null) net.drop(before);
      });
    } finally {
      leave();
    }
  }

  /**
   * Takes a map away; what was tracked in it is forgotten.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: there is none of this id
   */
  public void removeMap(int mapId) {
    enter();
    try {
      check(Native.localizerRemoveMap(pointer, mapId));
      net.drop(maps.remove(mapId));
    } finally {
      leave();
    }
  }

  /**
   * Where a map lies in a frame that several maps share: x_common = R x_map + t, with its errors, one sigma an axis.
   * Null: there is no such frame, as at first.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: there is no such map, or a number is beyond its limits
   */
  public void setMapTransform(int mapId, Rigid commonFromMap, double rotationSigmaRad, double translationSigmaM) {
    enter();
    try {
      check(Native.localizerSetMapTransform(pointer, mapId, commonFromMap == null ? 0 : commonFromMap.address,
          rotationSigmaRad, translationSigmaM));
    } finally {
      leave();
      Reference.reachabilityFence(commonFromMap);
    }
  }

  /** How many maps it has. */
  public int getMapCount() {
    enter();
    try {
      return Native.localizerMapCount(pointer);
    } finally {
      leave();
    }
  }

  /**
   * Where was the colour camera?  True: localized; result.cameraFromMap says where.  False: not localized, which is an
   * answer too; result.outcome says why.  Makes no garbage.
   *
   * @throws SpherecloudException the frame does not fit; the localizer goes on with the next one
   */
  public boolean process(Frame frame, Result result) {
    Objects.requireNonNull(frame, "frame");
    Objects.requireNonNull(result, "result");
    enter();
    try {
      extraction.enter();
      try {
        frame.requireImages();
        return answered(Native.localizerProcess(pointer, frame.address, result.address));
      } finally {
        extraction.leave();
      }
    } finally {
      leave();
      Reference.reachabilityFence(frame);
      Reference.reachabilityFence(result);
    }
  }

  /**
   * The first half of {@link #process}: fills the features by the images of the frame, which may go afterwards.  May run
   * while another thread calls {@link #locate} with other features.
   *
   * @throws SpherecloudException the frame does not fit; the features stay what they were
   */
  public void extract(Frame frame, Features features) {
    Objects.requireNonNull(frame, "frame");
    Objects.requireNonNull(features, "features");
    extraction.enter();
    try {
      frame.requireColorImages();
      long into = features.enter();
      try {
        features.check(Native.localizerExtract(pointer, frame.address, into));
      } finally {
        features.leave();
      }
    } finally {
      extraction.leave();
      Reference.reachabilityFence(frame);
      Reference.reachabilityFence(this);
    }
  }

  /**
   * The second half of {@link #process}, with the same result; of the frame the colour image is not looked at.
   *
   * @throws SpherecloudException the frame does not fit, has another time than the features, or they are of no frame yet
   */
  public boolean locate(Frame frame, Features features, Result result) {
    Objects.requireNonNull(frame, "frame");
    Objects.requireNonNull(features, "features");
    Objects.requireNonNull(result, "result");
    enter();
    try {
      frame.requireDepthImages();
      long from = features.enterShared();
      try {
        return answered(Native.localizerLocate(pointer, frame.address, from, result.address));
      } finally {
        features.leaveShared();
      }
    } finally {
      leave();
      Reference.reachabilityFence(frame);
      Reference.reachabilityFence(result);
    }
  }

  /**
   * Where the camera is at a time of the caller's, in the time of frames: up to a second after the last pose, or up to
   * 100 ms before it (where odometry goes on from it: before the last frame).  False: it is not known.  Makes no garbage.
   */
  public boolean predict(long timeNs, Prediction prediction) {
    Objects.requireNonNull(prediction, "prediction");
    enter();
    try {
      int status = Native.localizerPredict(pointer, timeNs, prediction.address);
      Failure.checkStruct(status, "Prediction");
      return status == Status.OK.value;
    } finally {
      leave();
      Reference.reachabilityFence(prediction);
    }
  }

  /** What became of the keypoints of the last processed frame; returns how many there are, also where fewer fit in. */
  public int observations(Observations into) {
    Objects.requireNonNull(into, "into");
    Scratch scratch = Scratch.mine();
    enter();
    try {
      Failure.checkStruct(Native.localizerObservations(pointer, into.address, Layout.LOCALIZER_OBSERVATION_BYTES,
          into.capacity(), scratch.address(0)), "Observation");
      into.fill(scratch.count());
      return scratch.count();
    } finally {
      leave();
      Reference.reachabilityFence(into);
    }
  }

  /** The poses that the last processed frame may have, those of most gain first; returns how many there are. */
  public int hypotheses(Hypotheses into) {
    Objects.requireNonNull(into, "into");
    Scratch scratch = Scratch.mine();
    enter();
    try {
      Failure.checkStruct(Native.localizerHypotheses(pointer, into.address, Layout.LOCALIZER_HYPOTHESIS_BYTES,
          into.capacity(), scratch.address(0)), "Hypothesis");
      into.fill(scratch.count());
      return scratch.count();
    } finally {
      leave();
      Reference.reachabilityFence(into);
    }
  }

  /**
   * How the search goes, from the next frame on: for those who measure.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: out of range
   */
  public void setParameter(Parameter parameter, double value) {
    Objects.requireNonNull(parameter, "parameter");
    enter();
    try {
      check(Native.localizerSetParameter(pointer, parameter.value, value));
    } finally {
      leave();
    }
  }

  /** What {@link #setParameter} set, or its default. */
  public double getParameter(Parameter parameter) {
    Objects.requireNonNull(parameter, "parameter");
    Scratch scratch = Scratch.mine();
    double[] value = new double[1];
    enter();
    try {
      checkParameter(Native.localizerGetParameter(pointer, parameter.value, scratch.address(0)), parameter);
      scratch.get(0, value);
      return value[0];
    } finally {
      leave();
    }
  }

  /** What a parameter is where it was not set, and may be set to.  Any thread may ask. */
  public static ParameterRange parameterRange(Parameter parameter) {
    Objects.requireNonNull(parameter, "parameter");
    ParameterRange range = new ParameterRange();
    checkParameter(Native.localizerGetParameterRange(parameter.value, range.address), parameter);
    return range;
  }

  private static void checkParameter(int status, Parameter parameter) {
    if (status < 0) throw Failure.of(status, "This library has no parameter " + parameter + "; ask for another one");
  }

  /**
   * What is known of the depth sensor from before, such as result.depth of the last frame before the power was cut.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: it cannot be one of this config
   */
  public void setDepthBias(DepthBias depth) {
    Objects.requireNonNull(depth, "depth");
    enter();
    try {
      check(Native.localizerSetDepthBias(pointer, depth.address));
    } finally {
      leave();
      Reference.reachabilityFence(depth);
    }
  }

  /** Forgets where the camera was, as after a long pause; what was learnt of the depth sensor stays. */
  public void reset() {
    enter();
    try {
      Native.localizerReset(pointer);
    } finally {
      leave();
    }
  }

  /** Gives its memory back, and the maps that it has.  A second time it does nothing. */
  @Override
  public void close() {
    if (guard.isClosed()) return;
    extraction.enter();
    boolean ended = false;
    try {
      ended = guard.close();
    } finally {
      if (ended) extraction.end();
      else extraction.leave();
    }
    if (ended) net.release();
  }

  private void enter() {
    guard.enter();
  }

  private void leave() {
    guard.leave();
    Reference.reachabilityFence(this);
  }

  /** Of calls that set the localizer's message: those that take it as const leave the one of an earlier call. */
  private void check(int status) {
    if (status < 0) throw Failure.of(status, Native.localizerMessage(pointer));
  }

  private boolean answered(int status) {
    check(status);
    return status == Status.OK.value;
  }
}
