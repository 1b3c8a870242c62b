package org.spherecloud;

/** Statuses that become exceptions. */
final class Failure {
  private Failure() {}

  /** Of calls that have no message of their own. */
  static void check(int status, String text) {
    if (status < 0) throw new SpherecloudException(status, text);
  }

  /** Of calls that fail only for the size of a struct, and have no message of their own. */
  static void checkStruct(int status, String struct) {
    if (status < 0) {
      throw of(status, "The library does not know a " + struct + " of this size; take the jar and the JNI library from one"
          + " release");
    }
  }

  /** Of calls that left their message in this scratch. */
  static void check(int status, Scratch scratch) {
    if (status < 0) throw of(status, scratch.message());
  }

  static SpherecloudException of(int status, String message) {
    return new SpherecloudException(status, message.isEmpty() ? "The call was refused" : message);
  }
}
