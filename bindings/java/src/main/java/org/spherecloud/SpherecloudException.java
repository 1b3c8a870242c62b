package org.spherecloud;

/** A call of the library failed; the message says the cause and the cure. */
public final class SpherecloudException extends RuntimeException {
  private static final long serialVersionUID = 1;

  /** The status as the C interface numbers it. */
  private final int code;

  SpherecloudException(int code, String text) {
    super(text + " [" + Native.statusName(code) + "]");
    this.code = code;
  }

  /** What kind of failure; {@link Status#UNKNOWN} where this version has no name for {@link #getCode}. */
  public Status getStatus() {
    return Status.of(code);
  }

  /** The status as a number of the C interface. */
  public int getCode() {
    return code;
  }
}
