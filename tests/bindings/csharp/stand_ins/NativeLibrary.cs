// As much of .NET 5 as the binding uses and mono has not, so that it is known to compile.
using System.Reflection;

namespace System.Runtime.InteropServices {
internal delegate IntPtr DllImportResolver(string name, Assembly assembly, DllImportSearchPath? search);

internal static class NativeLibrary {
  internal static void SetDllImportResolver(Assembly assembly, DllImportResolver resolver) {}

  internal static IntPtr Load(string path) {
    return IntPtr.Zero;
  }
}
}
