package org.spherecloud;

/** Room for {@link Localizer#observations}, made once and filled again and again. */
public final class Observations extends StructList<Observation> {
  /** For so many keypoints: config.maxKeypoints takes all. */
  public Observations(int capacity) {
    super(capacity, Layout.LOCALIZER_OBSERVATION_BYTES, Observation::new);
  }
}
