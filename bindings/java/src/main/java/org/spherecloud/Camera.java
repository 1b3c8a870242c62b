package org.spherecloud;

import java.lang.ref.Reference;
import java.util.Objects;

/** Camera intrinsics, in pixels of an image of width x height; the centre of the top-left pixel is (0.5, 0.5). */
public final class Camera extends CameraFields {
  /** All zero; {@link #set} it. */
  public Camera() {}

  /** See {@link #set(CameraModel, int, int, double...)}. */
  public Camera(CameraModel model, int width, int height, double... params) {
    set(model, width, height, params);
  }

  Camera(Struct whole, int at) {
    super(whole, at);
  }

  /** Sets all of it; the parameters in the order of the model, which says how many: fx fy cx cy, then distortion. */
  public void set(CameraModel model, int width, int height, double... params) {
    Objects.requireNonNull(params, "params");
    if (params.length > 12) throw new IllegalArgumentException(params.length + " parameters; no model has more than 12");
    setModel(model);
    setWidth(width);
    setHeight(height);
    setParamCount(params.length);
    setParams(java.util.Arrays.copyOf(params, 12));
  }

  /** In pixels. */
  @Override
  public void setWidth(int width) {
    super.setWidth(side(width, "width"));
  }

  /** In pixels. */
  @Override
  public void setHeight(int height) {
    super.setHeight(side(height, "height"));
  }

  /** A negative number would reach the library as one of billions. */
  private static int side(int pixels, String name) {
    if (pixels < 0) {
      throw new IllegalArgumentException("The " + name + " of a camera's image is " + pixels + "; give "
          + Limits.CAMERA_MIN_PX + " to " + Limits.CAMERA_MAX_PX + " pixels");
    }
    return pixels;
  }

  /** Takes over another one. */
  public void set(Camera other) {
    copy(other, Layout.CAMERA_BYTES);
  }

  /** One of its own that does not change with this one. */
  public Camera copy() {
    Camera made = new Camera();
    made.set(this);
    return made;
  }

  /**
   * Does nothing where the camera can be used.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: it cannot; the message names field, cause and cure
   */
  public void check() {
    Scratch scratch = Scratch.mine();
    int status = Native.cameraCheck(address, scratch.messageAddress());
    Reference.reachabilityFence(this);
    Failure.check(status, scratch);
  }

  /**
   * The pixel of a point in camera coordinates: three numbers in, two numbers out.  False where it has none: it is not
   * in front of the camera, more than about 89 degrees off the axis (83 for the Brown models), or beyond the range in
   * which the distortion can be inverted.
   *
   * @throws SpherecloudException the camera itself does not pass {@link #check}
   */
  public boolean project(double[] pointM, double[] pixelPx) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(pointM, 3, "pointM"));
    Scratch.sized(pixelPx, 2, "pixelPx");
    return answered(Native.cameraProject(address, scratch.address(0), scratch.address(4)), scratch, pixelPx);
  }

  /**
   * The unit bearing of a pixel, in camera coordinates: two numbers in, three numbers out.  False where it has none.
   *
   * @throws SpherecloudException the camera itself does not pass {@link #check}
   */
  public boolean unproject(double[] pixelPx, double[] bearing) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(pixelPx, 2, "pixelPx"));
    Scratch.sized(bearing, 3, "bearing");
    return answered(Native.cameraUnproject(address, scratch.address(0), scratch.address(4)), scratch, bearing);
  }

  private boolean answered(int status, Scratch scratch, double[] answer) {
    if (status == Status.OK.value) scratch.get(4, answer);
    else check();
    Reference.reachabilityFence(this);
    return status == Status.OK.value;
  }
}
