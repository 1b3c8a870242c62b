namespace SphereCloud {
/// <remarks>Its three parts are the pose, the vertical and odometry. A part counts once its method here was called, or once
/// Flags has its bit; properties alone do not make it count. What is out of range, the call that takes the frame
/// refuses.</remarks>
public sealed unsafe partial class LocalizerPrior {
  /// <summary>Where the camera should be, in this map's frame. 1 sigma an axis: of the rotation, and of the camera's
  /// centre.</summary>
  public void SetPose(uint mapId, Rigid cameraFromMap, double rotationSigmaRad, double translationSigmaM) {
    MapId = mapId;
    CameraFromMap = cameraFromMap;
    RotationSigmaRad = rotationSigmaRad;
    TranslationSigmaM = translationSigmaM;
    Flags |= PriorParts.Pose;
  }

  /// <summary>The vertical from an inertial sensor: the same direction in both frames; neither need be a unit vector. 1 sigma an
  /// axis. A pose of the same prior is in the same map.</summary>
  public void SetUp(uint mapId, Vector3d upCamera, Vector3d upMap, double sigmaRad) {
    MapId = mapId;
    UpCamera = upCamera;
    UpMap = upMap;
    UpSigmaRad = sigmaRad;
    Flags |= PriorParts.Up;
  }

  /// <summary>The device's own dead reckoning at the time of the colour image. 1 sigma an axis, of the step from the frame
  /// before.</summary>
  public void SetOdometry(Rigid odometryFromCamera, double rotationSigmaRad, double translationSigmaM) {
    OdometryFromCamera = odometryFromCamera;
    OdometryRotationSigmaRad = rotationSigmaRad;
    OdometryTranslationSigmaM = translationSigmaM;
    Flags |= PriorParts.Odometry;
  }
}
}
