package org.spherecloud;

/** A monotonic clock for stage times and deadlines. */
@FunctionalInterface
public interface Clock {
  /** Nanoseconds since a moment that does not change; never less than before. */
  long timeNs();
}
