#if NET5_0_OR_GREATER
using System;
using System.Reflection;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Lets the variable SPHERECLOUD_LIBRARY name the native library, where the runtime can be asked to.</summary>
internal static class LibraryResolver {
  internal static void Register() {
    NativeLibrary.SetDllImportResolver(typeof(LibraryResolver).Assembly, Resolve);
  }

  /// <summary>Zero means: look in the usual places.</summary>
  private static IntPtr Resolve(string name, Assembly assembly, DllImportSearchPath? search) {
    string path = Environment.GetEnvironmentVariable("SPHERECLOUD_LIBRARY");
    return name == Native.File && !string.IsNullOrEmpty(path) ? NativeLibrary.Load(path) : IntPtr.Zero;
  }
}
}
#endif
