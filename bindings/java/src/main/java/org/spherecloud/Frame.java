package org.spherecloud;

/**
 * A colour and a depth image taken at about the same time.  Make one and set it anew for each pair of images.  It belongs
 * to one thread at a time; nobody changes it during a call.
 */
public final class Frame extends FrameFields {
  private final StructList<CameraView> views;
  private final StructList<DepthView> depthViews;
  private Prior prior;
  private Camera colorCamera;
  private Rigid colorFromDepth;
  private Camera depthCamera;

  /** For a rig without further cameras. */
  public Frame() {
    this(0);
  }

  /** For rigs with so many further cameras: config.cameraCount. */
  public Frame(int viewCount) {
    this(viewCount, 0);
  }

  /** For rigs with so many further cameras and further depth cameras: config.cameraCount and config.depthCameraCount. */
  public Frame(int viewCount, int depthViewCount) {
    views = new StructList<>(viewCount, Layout.LOCALIZER_VIEW_BYTES, CameraView::new);
    if (viewCount > 0) putPointer(Layout.LOCALIZER_FRAME_VIEWS, views);
    putInt(Layout.LOCALIZER_FRAME_VIEW_COUNT, viewCount);
    depthViews = new StructList<>(depthViewCount, Layout.LOCALIZER_DEPTH_VIEW_BYTES, DepthView::new);
    if (depthViewCount > 0) putPointer(Layout.LOCALIZER_FRAME_DEPTH_VIEWS, depthViews);
    putInt(Layout.LOCALIZER_FRAME_DEPTH_VIEW_COUNT, depthViewCount);
  }

  /** The image of a further camera, from 0 in the order of config.cameras. */
  public CameraView getView(int index) {
    return views.at(index);
  }

  /** How many further cameras it is for. */
  public int getViewCount() {
    return views.capacity();
  }

  /** The image of a further depth camera, from 0 in the order of config.depthCameras. */
  public DepthView getDepthView(int index) {
    return depthViews.at(index);
  }

  /** How many further depth cameras it is for. */
  public int getDepthViewCount() {
    return depthViews.capacity();
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

  /**
   * The depth camera as it is in this frame, with heat or focus; null: as in the config.  Of a RANGE format, cosines stay
   * those of the config's.  It is read when the frame is.
   */
  public void setDepthCamera(Camera depthCamera) {
    this.depthCamera = depthCamera;
    putPointer(Layout.LOCALIZER_FRAME_DEPTH_CAMERA, depthCamera);
  }

  /** What {@link #setDepthCamera} was given. */
  public Camera getDepthCamera() {
    return depthCamera;
  }

  /** Fails where the memory of an image was given back. */
  void requireImages() {
    requireColorImages();
    requireDepthImages();
  }

  /** The same of the images that the first half of a frame reads. */
  void requireColorImages() {
    getColor().requireData();
    for (int i = 0; i < views.capacity(); i++) views.at(i).getImage().requireData();
  }

  /** The same of the second half. */
  void requireDepthImages() {
    getDepth().requireData();
    getAmplitude().requireData();
    for (int i = 0; i < depthViews.capacity(); i++) depthViews.at(i).requireImages();
  }
}
