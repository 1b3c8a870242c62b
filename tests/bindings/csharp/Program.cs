// The binding's tests without a framework: every public static method of the classes below is a test.
using System;
using System.Diagnostics;
using System.Reflection;

internal static class Program {
  private static readonly Type[] suites = {
      typeof(LayoutTest), typeof(GoldenTest), typeof(ConventionTest), typeof(CameraTest), typeof(AlignerTest),
      typeof(FeaturesTest), typeof(ConfigTest), typeof(DepthCameraTest), typeof(MisuseTest), typeof(LifetimeTest),
      typeof(ThreadTest), typeof(ImageTest), typeof(PriorTest), typeof(UnityTest), typeof(SampleTest)};

  private static int Main(string[] names) {
    int passed = 0, failed = 0;
    var clock = Stopwatch.StartNew();
    foreach (Type suite in suites)
      foreach (MethodInfo test in suite.GetMethods(BindingFlags.Public | BindingFlags.Static | BindingFlags.DeclaredOnly)) {
        string name = suite.Name + "." + test.Name;
        if (names.Length > 0 && name.IndexOf(names[0], StringComparison.Ordinal) < 0) continue;
        if (Run(name, test)) ++passed;
        else ++failed;
      }
    Console.WriteLine(passed + " passed, " + failed + " failed");
    Console.WriteLine("in " + clock.ElapsedMilliseconds + " ms");
    return failed > 0 || passed == 0 ? 1 : 0;
  }

  private static bool Run(string name, MethodInfo test) {
    try {
      test.Invoke(null, null);
      return true;
    } catch (TargetInvocationException failure) {
      Console.WriteLine("FAILED " + name + ": " + failure.InnerException);
      return false;
    }
  }
}
