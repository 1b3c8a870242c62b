package org.spherecloud;

/**
 * A colour and a depth image taken at about the same time.  Make one and set it anew for each pair of images.  It belongs
 * to one thread at a time; nobody changes it during a call.
 */
public final class Frame extends FrameFields {
  private final StructList<CameraView> views;
  private Prior prior;
  private Camera colorCamera;
  private Rigid colorFromDepth;

  /** For a rig without further cameras. */
  public Frame() {
    this(0);
  }

  /** For rigs with so many further cameras: config.cameraCount. */
  public Frame(int viewCount) {
    views = new StructList<>(viewCount, Layout.LOCALIZER_VIEW_BYTES, CameraView::new);
    if (viewCount > 0) putPointer(Layout.LOCALIZER_FRAME_VIEWS, views);
    putInt(Layout.LOCALIZER_FRAME_VIEW_COUNT, viewCount);
  }

  /** The image of a further camera, from 0 in the order of config.cameras. */
  public CameraView getView(int index) {
    return views.at(index);
  }

  /** How many further cameras it is for. */
  public int getViewCount() {
    return views.capacity();
  }

  /** What is known of the pose from before; null: nothing.  It is read when the frame is. */
  public void setPrior(Prior prior) {
    this.prior = prior;
    putPointer(Layout.LOCALIZER_FRAME_PRIOR, prior);
  }

  /** What {@link #setPrior} was given. */
  public Prior getPrior() {
    return prior;
  }

  /** The colour camera as it is in this frame, with heat or focus; null: as in the config.  It is read when the frame is. */
  public void setColorCamera(Camera colorCamera) {
    this.colorCamera = colorCamera;
    putPointer(Layout.LOCALIZER_FRAME_COLOR_CAMERA, colorCamera);
  }

  /** What {@link #setColorCamera} was given. */
  public Camera getColorCamera() {
    return colorCamera;
  }

  /** Where the depth camera is in this frame; null: as in the config.  It is read when the frame is. */
  public void setColorFromDepth(Rigid colorFromDepth) {
    this.colorFromDepth = colorFromDepth;
    putPointer(Layout.LOCALIZER_FRAME_COLOR_FROM_DEPTH, colorFromDepth);
  }

  /** What {@link #setColorFromDepth} was given. */
  public Rigid getColorFromDepth() {
    return colorFromDepth;
  }

  /** Fails where the memory of an image was given back. */
  void requireImages() {
    getColor().requireData();
    getDepth().requireData();
    getAmplitude().requireData();
    for (int i = 0; i < views.capacity(); i++) views.at(i).getImage().requireData();
  }
}
