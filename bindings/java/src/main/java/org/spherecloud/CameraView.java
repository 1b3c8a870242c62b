package org.spherecloud;

/** The image of a further camera of the rig; a part of a {@link Frame}. */
public final class CameraView extends CameraViewFields {
  private Camera camera;
  private Rigid colorFromCamera;

  CameraView(Struct whole, int at) {
    super(whole, at);
    Failure.checkStruct(Native.localizerViewInit(address, Layout.LOCALIZER_VIEW_BYTES), "CameraView");
  }

  /** The camera as it is in this frame, with heat or focus; null: as in the config.  It is read when the frame is. */
  public void setCamera(Camera camera) {
    this.camera = camera;
    putPointer(Layout.LOCALIZER_VIEW_CAMERA, camera);
  }

  /** What {@link #setCamera} was given. */
  public Camera getCamera() {
    return camera;
  }

  /** Where the camera is in this frame; null: as in the config.  It is read when the frame is. */
  public void setColorFromCamera(Rigid colorFromCamera) {
    this.colorFromCamera = colorFromCamera;
    putPointer(Layout.LOCALIZER_VIEW_COLOR_FROM_CAMERA, colorFromCamera);
  }

  /** What {@link #setColorFromCamera} was given. */
  public Rigid getColorFromCamera() {
    return colorFromCamera;
  }
}
