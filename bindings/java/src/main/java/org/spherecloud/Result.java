package org.spherecloud;

import java.lang.ref.Reference;

/** What was found in a frame.  Make one and hand it to every {@link Localizer#process}; it belongs to one thread at a time. */
public final class Result extends ResultFields {
  /** Says nothing yet: its outcome is {@link Outcome#UNKNOWN}, and its map {@link Limits#MAP_NONE}. */
  public Result() {
    putInt(Layout.LOCALIZER_RESULT_OUTCOME, Outcome.UNKNOWN.value); // zero would be LOCALIZED
    putInt(Layout.LOCALIZER_RESULT_MAP_ID, Limits.MAP_NONE);
  }

  /** Takes over all that the other one says, to keep it. */
  public void set(Result other) {
    copy(other, Layout.LOCALIZER_RESULT_BYTES);
  }

  /** The probability that the camera is within so many metres and radians of the pose; 0 where there is no pose. */
  public double getConfidence(double translationM, double rotationRad) {
    double confidence = Native.localizerResultConfidence(address, translationM, rotationRad);
    Reference.reachabilityFence(this);
    return confidence;
  }

  /** Outcome, inliers and pose in a line. */
  @Override
  public String toString() {
    return getOutcome() + ", " + getInliers() + " inliers, confidence " + getConfidence() + ", camera_from_map "
        + getCameraFromMap();
  }
}
