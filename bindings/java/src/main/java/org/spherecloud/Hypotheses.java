package org.spherecloud;

/** Room for {@link Localizer#hypotheses}, made once and filled again and again. */
public final class Hypotheses extends StructList<Hypothesis> {
  /** For all that a frame can have. */
  public Hypotheses() {
    super(Limits.HYPOTHESES_MAX, Layout.LOCALIZER_HYPOTHESIS_BYTES, Hypothesis::new);
  }
}
