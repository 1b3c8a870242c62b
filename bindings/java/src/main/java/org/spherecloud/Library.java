package org.spherecloud;

/** Finds and loads the JNI library, once, and refuses one that is not of this jar's release. */
final class Library {
  private Library() {}

  private static final String NAME = "spherecloud_jni";
  private static final String PROPERTY = "spherecloud.jni";
  private static final String VARIABLE = "SPHERECLOUD_JNI";
  private static final String CURE = "Name the file by -D" + PROPERTY + "=FILE or " + VARIABLE
      + "=FILE, or its folder by -Djava.library.path=FOLDER.";

  /** Why there is none; null: it is loaded. */
  private static final UnsatisfiedLinkError FAILURE = failure();

  /**
   * Loads it at the first call, and says whether it is there.  For static initialisers, none of which may fail: Java
   * tells later users of such a class its name alone.
   */
  static boolean load() {
    return FAILURE == null;
  }

  /** Fails where there is none, each time with the whole explanation. */
  static void require() {
    if (FAILURE == null) return;
    UnsatisfiedLinkError again = new UnsatisfiedLinkError(FAILURE.getMessage());
    again.initCause(FAILURE);
    throw again;
  }

  private static UnsatisfiedLinkError failure() {
    try {
      String path = System.getProperty(PROPERTY, System.getenv(VARIABLE));
      if (path != null) loadFile(path);
      else loadInstalled();
      String said = ask(path != null ? path : System.mapLibraryName(NAME));
      return said == null ? null : new UnsatisfiedLinkError(said);
    } catch (UnsatisfiedLinkError failed) {
      return failed;
    }
  }

  private static void loadFile(String path) {
    try {
      System.load(new java.io.File(path).getAbsolutePath());
    } catch (UnsatisfiedLinkError missing) {
      throw explained(path + ", which the property " + PROPERTY + " or the variable " + VARIABLE + " names", missing);
    }
  }

  private static void loadInstalled() {
    try {
      System.loadLibrary(NAME);
    } catch (UnsatisfiedLinkError missing) {
      String folders = System.getProperty("java.library.path");
      throw explained(System.mapLibraryName(NAME) + " in java.library.path (" + folders + ")", missing);
    }
  }

  private static UnsatisfiedLinkError explained(String where, UnsatisfiedLinkError missing) {
    UnsatisfiedLinkError error = new UnsatisfiedLinkError("The JNI library of SphereCloud cannot be loaded; looked for "
        + where + ". " + CURE + " The cause: " + missing.getMessage());
    error.initCause(missing);
    return error;
  }

  /** What is wrong with the library that was loaded; null: nothing. */
  private static String ask(String file) {
    try {
      return check(abi(), version(), fingerprint());
    } catch (UnsatisfiedLinkError noneOfThem) {
      return file + " is not the JNI library of SphereCloud: it has no functions for Java, as the C library has none. The"
          + " one that is needed is " + System.mapLibraryName(NAME) + ". " + CURE;
    }
  }

  /** What is wrong with a library of such a release; null: nothing. */
  static String check(int abi, String version, int fingerprint) {
    if (abi == Release.ABI && version.equals(Release.VERSION) && fingerprint == Release.FINGERPRINT) return null;
    return "The JNI library is of SphereCloud " + version + " (ABI " + abi + ", interface " + fingerprint
        + ") and the jar of " + Release.VERSION + " (ABI " + Release.ABI + ", interface " + Release.FINGERPRINT
        + "); take both from one release.";
  }

  private static native int abi();

  private static native String version();

  private static native int fingerprint();
}
