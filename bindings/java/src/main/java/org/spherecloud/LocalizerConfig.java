package org.spherecloud;

import java.util.Objects;

/** What a {@link Localizer} is made for.  New ones have the defaults; their cameras are zero and must be set. */
public final class LocalizerConfig extends LocalizerConfigFields {
  private StructList<RigCamera> cameras;
  private StructList<DepthCamera> depthCameras;
  private Log log;
  private Clock clock;

  /** The defaults, with the system's monotonic clock, that of System.nanoTime. */
  public LocalizerConfig() {
    setClock(null);
  }

  /** The further cameras of the rig, beside the colour camera.  They are copied. */
  public void setCameras(RigCamera... further) {
    cameras = copies("cameras", further, Layout.LOCALIZER_CAMERA_BYTES, RigCamera::new);
    putPointer(Layout.LOCALIZER_CONFIG_CAMERAS, cameras);
    putInt(Layout.LOCALIZER_CONFIG_CAMERA_COUNT, further.length);
  }

  /** How many further cameras the rig has. */
  public int getCameraCount() {
    return getInt(Layout.LOCALIZER_CONFIG_CAMERA_COUNT);
  }

  /** The further depth cameras of the rig, beside that of {@link #getRig}.  They are copied. */
  public void setDepthCameras(DepthCamera... further) {
    depthCameras = copies("depthCameras", further, Layout.LOCALIZER_DEPTH_CAMERA_BYTES, DepthCamera::new);
    putPointer(Layout.LOCALIZER_CONFIG_DEPTH_CAMERAS, depthCameras);
    putInt(Layout.LOCALIZER_CONFIG_DEPTH_CAMERA_COUNT, further.length);
  }

  /** How many further depth cameras the rig has. */
  public int getDepthCameraCount() {
    return getInt(Layout.LOCALIZER_CONFIG_DEPTH_CAMERA_COUNT);
  }

  /** A list of its own, null where it is empty.  What it replaces stays until it is whole: the struct points there. */
  private static <E extends Struct> StructList<E> copies(String name, E[] of, int bytes, StructList.Maker<E> maker) {
    Objects.requireNonNull(of, name);
    for (int i = 0; i < of.length; i++) Objects.requireNonNull(of[i], name + "[" + i + "] is null; give one that is made");
    if (of.length == 0) return null;
    StructList<E> made = new StructList<>(of.length, bytes, maker);
    for (int i = 0; i < of.length; i++) made.at(i).copy(of[i], bytes);
    return made;
  }

  /** Lines of this level, and of those that say less, go to the log; {@link LogLevel#DEBUG} has one for every frame. */
  public void setLog(LogLevel level, Log log) {
    putInt(Layout.LOCALIZER_CONFIG_LOG_LEVEL, Objects.requireNonNull(level, "level").value);
    this.log = log;
  }

  /** A clock of the caller's, as of a recording that is played; null: the system's monotonic clock. */
  public void setClock(Clock clock) {
    this.clock = clock;
    putPointer(Layout.LOCALIZER_CONFIG_CLOCK,
        clock == null ? Callback.monotonicClockFunction() : Callback.clockFunction());
  }

  /** What the library is told: this config, and references to what it calls, which the net holds. */
  Struct told(Net net) {
    Struct told = new Struct(Layout.LOCALIZER_CONFIG_BYTES);
    told.copy(this, Layout.LOCALIZER_CONFIG_BYTES);
    if (log != null) {
      told.putPointer(Layout.LOCALIZER_CONFIG_LOG, Callback.logFunction());
      told.putPointer(Layout.LOCALIZER_CONFIG_LOG_USER, net.hold(new Callback(log)).user);
    }
    if (clock != null) told.putPointer(Layout.LOCALIZER_CONFIG_CLOCK_USER, net.hold(new Callback(clock)).user);
    return told;
  }
}
