using System;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>The native library behind this assembly.</summary>
public static unsafe class Library {
  private static readonly Exception problem = FindProblem();

  /// <summary>"major.minor.patch" of the native library. Any thread. Throws SpherecloudException where the library
  /// is of another version, and DllNotFoundException where it is missing.</summary>
  public static string Version {
    get {
      Require();
      return Text.Of(Native.sphc_version_string());
    }
  }

  /// <summary>The id of the library's keypoint extractor: maps and features of another one are refused. Any
  /// thread.</summary>
  public static uint ExtractorId {
    get {
      Require();
      return Native.sphc_extractor_id();
    }
  }

  /// <summary>Bytes of a row of so many pixels, the least stride; 0 for a format that the library does not know,
  /// and for a width that it cannot have. Any thread.</summary>
  public static int RowBytes(PixelFormat format, int width) {
    Require();
    uint bytes = width < 0 ? 0 : Native.sphc_format_row_bytes(format, (uint)width);
    return bytes > int.MaxValue ? 0 : (int)bytes;
  }

  /// <summary>Everything public passes here before its first native call.</summary>
  internal static void Require() {
    if (problem != null) throw Again(problem);
  }

  private static Exception FindProblem() {
    try {
#if NET5_0_OR_GREATER
      LibraryResolver.Register();
#endif
      return VersionProblem(Native.sphc_abi(), Text.Of(Native.sphc_version_string()));
    } catch (DllNotFoundException missing) {
      return new DllNotFoundException(WhereToLook + " The system says: " + missing.Message, missing);
    } catch (BadImageFormatException other) {
      return new DllNotFoundException("A library '" + Native.File + "' was found, but it is not one of this processor: " +
                                      other.Message, other);
    } catch (EntryPointNotFoundException other) {
      return new DllNotFoundException("A library '" + Native.File + "' was found, but it is not that of SphereCloud " +
                                      Native.Version + ": " + other.Message, other);
    }
  }

  /// <summary>Null where this assembly and a library of that ABI fit each other.</summary>
  internal static Exception VersionProblem(uint abi, string version) {
    return abi == Native.Abi ? null : new SpherecloudException(
        Status.Unsupported, "the native library is " + version + " (ABI " + abi + "), and this assembly is made for " +
                            Native.Version + " (ABI " + Native.Abi + "); install both from one release");
  }

  /// <summary>An exception keeps the place where it was first thrown, so each caller gets its own.</summary>
  private static Exception Again(Exception problem) {
    var known = problem as SpherecloudException;
    return known != null ? (Exception)new SpherecloudException(known.Status, known.Explanation)
                         : new DllNotFoundException(problem.Message, problem.InnerException);
  }

  private const string WhereToLook =
      "The native library '" + Native.File + "' was not found: libspherecloud.so, spherecloud.dll or " +
      "libspherecloud.dylib. Looked beside the program and where the system looks for libraries. In Unity put it into " +
      "Runtime/Plugins of the package with Tools~/place_library.py. With .NET 8 or newer set SPHERECLOUD_LIBRARY to its path, or " +
      "put it beside the program. With Mono name its folder in LD_LIBRARY_PATH, or its path in a <dllmap>.";
}

/// <summary>Strings of the library.</summary>
internal static unsafe class Text {
  internal static string Of(byte* text) {
    return Marshal.PtrToStringAnsi((IntPtr)text) ?? "";
  }
}

/// <summary>size_t.</summary>
internal static class Size {
  internal static UIntPtr Of(long bytes) {
    return (UIntPtr)(ulong)bytes;
  }
}
}
