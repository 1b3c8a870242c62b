package org.spherecloud;

/** What the library says of itself.  Any thread may call it. */
public final class Spherecloud {
  private Spherecloud() {}

  /** "major.minor.patch". */
  public static String version() {
    Library.require();
    return Native.versionString();
  }

  /** The id of the library's keypoint extractor; a map whose points another one described is refused. */
  public static int extractorId() {
    Library.require();
    return Native.extractorId();
  }
}
