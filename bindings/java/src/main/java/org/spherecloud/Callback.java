package org.spherecloud;

/** An object of the caller's that native code calls.  Written by hand in support.c. */
final class Callback implements Holding {
  /** What the C interface calls {@code user}. */
  final long user;

  Callback(Object called) {
    user = reference(called);
  }

  @Override
  public void release() {
    dropReference(user);
  }

  private static native long reference(Object called);

  private static native void dropReference(long user);

  /** C functions that call a {@link Log} and a {@link Clock}, and one that reads the system's monotonic clock. */
  static native long logFunction();

  static native long clockFunction();

  static native long monotonicClockFunction();

  /** Called by native code. */
  static void log(Log log, int level, String text) {
    log.line(LogLevel.of(level), text);
  }

  /** Called by native code. */
  static long time(Clock clock) {
    return clock.timeNs();
  }
}
