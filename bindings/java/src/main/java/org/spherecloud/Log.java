package org.spherecloud;

/** Takes lines of a localizer's log. */
@FunctionalInterface
public interface Log {
  /**
   * Called on the thread of the call that has something to say.  It must not call the localizer.  What it throws comes
   * out of that call.
   */
  void line(LogLevel level, String text);
}
