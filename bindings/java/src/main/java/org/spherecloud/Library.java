package org.spherecloud;

/** Finds and loads the JNI library, once, and refuses one that is not of this jar's release. */
final class Library {
  private Library() {}

  private static final String NAME = "spherecloud_jni";
  private static final String PROPERTY = "spherecloud.jni";
  private static final String VARIABLE = "SPHERECLOUD_JNI";

  static {
    String path = System.getProperty(PROPERTY, System.getenv(VARIABLE));
    if (path != null) loadFile(path);
    else loadInstalled();
    String said = check(abi(), version(), fingerprint());
    if (said != null) throw new UnsatisfiedLinkError(said);
  }

  /** Does nothing but that this class is initialised. */
  static void load() {}

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
        + where + ". Name the file by -D" + PROPERTY + "=FILE or " + VARIABLE
        + "=FILE, or its folder by -Djava.library.path=FOLDER. The cause: " + missing.getMessage());
    error.initCause(missing);
    return error;
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
