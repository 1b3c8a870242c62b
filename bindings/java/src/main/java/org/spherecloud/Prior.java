package org.spherecloud;

import java.util.Objects;

/** What is known of a pose before its frame is looked at.  Each of the three parts counts once it is set. */
public final class Prior extends PriorFields {
  /** Nothing is known. */
  public Prior() {}

  /** Nothing is known. */
  public void clear() {
    putInt(Layout.LOCALIZER_PRIOR_FLAGS, 0);
  }

  /** Where the camera should be, in this map's frame; one sigma an axis, of the camera's centre. */
  public void setPose(int mapId, Rigid cameraFromMap, double rotationSigmaRad, double translationSigmaM) {
    Objects.requireNonNull(cameraFromMap, "cameraFromMap");
    setMapId(mapId);
    getCameraFromMap().set(cameraFromMap);
    setRotationSigmaRad(rotationSigmaRad);
    setTranslationSigmaM(translationSigmaM);
    add(PriorPart.POSE);
  }

  /** The vertical from an inertial sensor: the same direction in both frames, of any usual length; one sigma an axis. */
  public void setUp(int mapId, double[] upCamera, double[] upMap, double sigmaRad) {
    Objects.requireNonNull(upCamera, "upCamera");
    Objects.requireNonNull(upMap, "upMap");
    setMapId(mapId);
    setUpCamera(upCamera);
    setUpMap(upMap);
    setUpSigmaRad(sigmaRad);
    add(PriorPart.UP);
  }

  /** The device's own dead reckoning at the time of the colour image; one sigma an axis, of the step since the last. */
  public void setOdometry(Rigid odometryFromCamera, double rotationSigmaRad, double translationSigmaM) {
    Objects.requireNonNull(odometryFromCamera, "odometryFromCamera");
    getOdometryFromCamera().set(odometryFromCamera);
    setOdometryRotationSigmaRad(rotationSigmaRad);
    setOdometryTranslationSigmaM(translationSigmaM);
    add(PriorPart.ODOMETRY);
  }

  private void add(PriorPart part) {
    putInt(Layout.LOCALIZER_PRIOR_FLAGS, getPriorPartBits() | part.bit);
  }
}
