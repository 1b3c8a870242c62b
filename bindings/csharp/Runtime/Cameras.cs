using System;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Intrinsics of a camera, in pixels of its image. The centre of the top-left pixel is (0.5, 0.5): add 0.5 to a
/// principal point of OpenCV.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct CameraIntrinsics {
  /// <summary>Says what the parameters are.</summary>
  public CameraModel Model;
  /// <summary>Of the image, in pixels.</summary>
  public uint Width;
  /// <summary>Of the image, in pixels.</summary>
  public uint Height;
  /// <summary>4, 9, 12 or 8, by model.</summary>
  public uint ParamCount;
  internal fixed double @params[12];

  /// <summary>Parameters in the order of the model, such as fx, fy, cx, cy. Throws ArgumentException where the fields cannot
  /// hold what is given; the rest is checked when the camera is used, or <see cref="Check"/> is called.</summary>
  public CameraIntrinsics(CameraModel model, int width, int height, params double[] parameters) : this() {
    if (parameters == null) throw new ArgumentNullException(nameof(parameters));
    if (parameters.Length > 12) throw new ArgumentException("a camera has 12 parameters at most", nameof(parameters));
    if (width < 0 || height < 0)
      throw new ArgumentException("a camera has " + width + " x " + height + " pixels; give the width and the height of its image");
    Model = model;
    Width = (uint)width;
    Height = (uint)height;
    ParamCount = (uint)parameters.Length;
    fixed (double* first = @params)
      for (int i = 0; i < parameters.Length; ++i) first[i] = parameters[i];
  }

  /// <summary>A camera without distortion.</summary>
  public static CameraIntrinsics Pinhole(int width, int height, double fx, double fy, double cx, double cy) {
    return new CameraIntrinsics(CameraModel.Pinhole, width, height, fx, fy, cx, cy);
  }

  /// <summary>A copy of the parameters.</summary>
  public double[] Parameters() {
    var copied = new double[Math.Min(ParamCount, 12)];
    fixed (double* first = @params)
      for (int i = 0; i < copied.Length; ++i) copied[i] = first[i];
    return copied;
  }

  /// <summary>Throws SpherecloudException, with field, cause and cure, if the camera cannot be used. Any thread.</summary>
  public void Check() {
    Library.Require();
    CameraIntrinsics camera = this;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_camera_check(&camera, &message), ref message);
  }

  /// <summary>Finds the pixel of a point in camera coordinates. False where the point is not in front of the camera,
  /// lies more than about 89 degrees off the axis (83 for the Brown models) or where the distortion cannot be inverted,
  /// or the camera cannot be used. Any thread.</summary>
  public bool TryProject(Vector3d pointM, out Vector2d pixelPx) {
    Library.Require();
    CameraIntrinsics camera = this;
    Vector2d pixel = default(Vector2d);
    Status status = Native.sphc_camera_project(&camera, (double*)&pointM, (double*)&pixel);
    pixelPx = pixel;
    return status == Status.Ok;
  }

  /// <summary>Finds the unit bearing of a pixel, in camera coordinates. False where no bearing projects there, or the
  /// camera cannot be used. Any thread.</summary>
  public bool TryUnproject(Vector2d pixelPx, out Vector3d bearing) {
    Library.Require();
    CameraIntrinsics camera = this;
    Vector3d found = default(Vector3d);
    Status status = Native.sphc_camera_unproject(&camera, (double*)&pixelPx, (double*)&found);
    bearing = found;
    return status == Status.Ok;
  }
}

public unsafe partial struct Rig {
  /// <summary>Two cameras, with the depth camera's place seen from the colour camera and metres for each unit of the
  /// depth image.</summary>
  public Rig(CameraIntrinsics colorCamera, CameraIntrinsics depthCamera, Rigid colorFromDepth,
             double depthUnitM = 0.001) {
    ColorCamera = colorCamera;
    DepthCamera = depthCamera;
    ColorFromDepth = colorFromDepth;
    DepthUnitM = depthUnitM;
  }

  /// <summary>Throws SpherecloudException, with field, cause and cure, if the rig cannot be used. Any thread.</summary>
  public void Check() {
    Library.Require();
    Rig rig = this;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_rig_check(&rig, &message), ref message);
  }
}
}
