using System;
using SphereCloud;

/// <summary>Structs lie in memory as C's do on the machine that the test runs on.</summary>
internal sealed class LayoutTest {
  private readonly int machine;
  private int compared;

  private LayoutTest(int machine) {
    this.machine = machine;
  }

  public static void StructsAreThoseOfC() {
    var test = new LayoutTest(Machine());
    GeneratedLayouts.Compare(test);
    Expect.True(test.compared > 200, "only " + test.compared + " sizes and offsets");
  }

  /// <summary>Of 64 bits all are alike; of 32 bits they differ in the alignment of double.</summary>
  private static unsafe int Machine() {
    string name = IntPtr.Size == 8 ? "x86_64-linux-gnu" : sizeof(Aligned) == 12 ? "i686-linux-gnu" : "armv7-linux-gnueabihf";
    return Array.IndexOf(GeneratedLayouts.Machines, name);
  }

  private struct Aligned {
    internal int first;
    internal double second;
  }

  internal void Same(string what, long found, params int[] told) {
    Expect.Equal((long)told[machine], found, what);
    ++compared;
  }
}
