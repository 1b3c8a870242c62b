package org.spherecloud;

/** The image of a further depth camera of the rig; a part of a {@link Frame}. */
public final class DepthView extends DepthViewFields {
  private Camera camera;
  private Rigid colorFromDepth;

  DepthView(Struct whole, int at) {
    super(whole, at);
    Failure.checkStruct(Native.localizerDepthViewInit(address, Layout.LOCALIZER_DEPTH_VIEW_BYTES), "DepthView");
  }

  /** The camera as it is in this frame, with heat or focus; null: as in the config.  It is read when the frame is. */
  public void setCamera(Camera camera) {
    this.camera = camera;
    putPointer(Layout.LOCALIZER_DEPTH_VIEW_CAMERA, camera);
  }

  /** What {@link #setCamera} was given. */
  public Camera getCamera() {
    return camera;
  }

  /** Where the camera is in this frame; null: as in the config.  It is read when the frame is. */
  public void setColorFromDepth(Rigid colorFromDepth) {
    this.colorFromDepth = colorFromDepth;
    putPointer(Layout.LOCALIZER_DEPTH_VIEW_COLOR_FROM_DEPTH, colorFromDepth);
  }

  /** What {@link #setColorFromDepth} was given. */
  public Rigid getColorFromDepth() {
    return colorFromDepth;
  }

  /** Fails where the memory of an image was given back. */
  void requireImages() {
    getDepth().requireData();
    getAmplitude().requireData();
  }
}
