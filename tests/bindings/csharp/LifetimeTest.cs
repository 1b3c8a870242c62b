using System;
using System.Runtime.CompilerServices;
using System.Threading;
using SphereCloud;

internal static class LifetimeTest {
  public static void AMapOutlivesItsDisposal() {
    var localizer = new Localizer(Session.Config());
    Map map = Map.Open(Session.MapPath);
    localizer.SetMap(1, map);
    map.Dispose();
    Collect();
    LocalizerResult result;
    Expect.True(localizer.Process(Session.Frame(0), out result), "localizes");
    Expect.True(Alive(map), "the map is there");
    localizer.RemoveMap(1);
    Expect.True(!Alive(map), "the map went when the localizer let it go");
    localizer.Dispose();
  }

  public static void ADisposedMapIsClosedWhileALocalizerHasIt() {
    using (var localizer = new Localizer(Session.Config()))
    using (Map map = Map.Open(Session.MapPath)) {
      localizer.SetMap(1, map);
      map.Dispose();
      map.Dispose();
      Expect.Throws<ObjectDisposedException>(() => { MapInfo info = map.Info; }, "Map");
      Expect.Throws<ObjectDisposedException>(() => map.Direction(0), "Map");
      Expect.Throws<ObjectDisposedException>(() => localizer.SetMap(2, map), "Map");
      Expect.Equal(1, localizer.MapCount, "maps");
      LocalizerResult result;
      Expect.True(localizer.Process(Session.Frame(0), out result), "localizes");
    }
  }

  /// <summary>Of memory that nothing refers to, the system alone knows.</summary>
  public static void AMapThatCannotBeReadLeavesNoMemory() {
    long before = AddressBytes();
    if (before == 0) return;  // another system than Linux
    for (int i = 0; i < 40; ++i)
      Expect.Throws<System.IO.EndOfStreamException>(() => new MapHandle(new ShorterThanItSays()), "became shorter");
    long more = AddressBytes() - before;
    Expect.True(more < 10 * ShorterThanItSays.Bytes, more + " bytes more");
  }

  private sealed class ShorterThanItSays : System.IO.MemoryStream {
    internal const long Bytes = 64 << 20;
    public override long Length { get { return Bytes; } }
    public override int Read(byte[] buffer, int offset, int count) { return 0; }
  }

  private static long AddressBytes() {
    const string pages = "/proc/self/statm";  // the whole is first
    if (!System.IO.File.Exists(pages)) return 0;
    return Environment.SystemPageSize * long.Parse(System.IO.File.ReadAllText(pages).Split(' ')[0]);
  }

  public static void AReplacedMapGoes() {
    using (var localizer = new Localizer(Session.Config())) {
      Map first = Map.Open(Session.MapPath), second = Map.Open(Session.MapPath);
      localizer.SetMap(1, first);
      localizer.SetMap(1, second);
      first.Dispose();
      second.Dispose();
      Expect.True(!Alive(first) && Alive(second), "the second stays");
      localizer.SetMap(1, Map.Open(Session.MapPath));
      Expect.True(!Alive(second), "the second goes");
    }
  }

  public static void ADisposedLocalizerLetsMapsGo() {
    Map map = Map.Open(Session.MapPath);
    Localizer localizer = new Localizer(Session.Config());
    localizer.SetMap(1, map);
    localizer.SetMap(2, map);
    map.Dispose();
    Expect.True(Alive(map), "the map is there");
    localizer.Dispose();
    Expect.True(!Alive(map), "the map goes");
  }

  /// <summary>In any order that the collector likes.</summary>
  public static void ForgottenObjectsAreFreed() {
    WeakReference[] forgotten = new WeakReference[20];
    var maker = new Thread(() => {  // whose stack goes, with every reference on it
      for (int i = 0; i < forgotten.Length; ++i) forgotten[i] = Forget();
    });
    maker.Start();
    maker.Join();
    Collect();
    int left = Array.FindAll(forgotten, f => f.IsAlive).Length;
    Expect.True(left <= 2, left + " of " + forgotten.Length + " localizers are left");
  }

  [MethodImpl(MethodImplOptions.NoInlining)]
  private static WeakReference Forget() {
    Localizer localizer = Session.Localizer();
    localizer.SetMap(2, Map.Open(Session.MapPath));
    return new WeakReference(localizer);
  }

  /// <summary>A call that is under way keeps the memory until it ends.</summary>
  public static void DisposalDuringACallWaitsForIt() {
    LocalizerConfig config = Session.Config();
    Localizer localizer = null;
    int calls = 0;
    config.Clock = () => {
      if (++calls == 2) localizer.Dispose();
      Collect();
      return MonotonicClock.NowNs();
    };
    localizer = Session.Localizer(config);
    LocalizerResult result;
    Expect.True(localizer.Process(Session.Frame(0), out result), "localizes");
    Expect.True(calls >= 2, "the clock was asked");
    Expect.Throws<ObjectDisposedException>(() => localizer.Process(Session.Frame(0), out result), "Localizer");
  }

  public static void ThreadsEndWithTheirLocalizer() {
    LocalizerConfig config = Session.Config();
    config.ParallelTasks = 8;
    int before = Threads();
    if (before == 0) return;  // another system than Linux
    using (Localizer localizer = Session.Localizer(config)) Expect.True(Threads() >= before + 7, "threads");
    for (int i = 0; i < 200 && Threads() > before; ++i) Thread.Sleep(10);
    Expect.True(Threads() <= before + 2, Threads() + " threads, " + before + " before");
  }

  private static int Threads() {
    return System.IO.Directory.Exists("/proc/self/task") ? System.IO.Directory.GetDirectories("/proc/self/task").Length : 0;
  }

  public static void FramesAllocateNothing() {
    AllocateNothing(Session.Config());
  }

  public static void FramesOnSeveralThreadsAllocateNothing() {
    LocalizerConfig config = Session.Config();
    config.ParallelTasks = 3;
    AllocateNothing(config);
  }

  private static void AllocateNothing(LocalizerConfig config) {
    LocalizerFrame[] frames = {Session.Frame(0), Session.Frame(1), Session.Frame(8)};
    LocalizerResult result;
    LocalizerPrediction prediction;
    using (Localizer localizer = Session.Localizer(config))
    using (var features = new Features(config)) {
      long before = 0;
      for (int i = 0; i < 12; ++i) {
        if (i == 3) before = GC.GetAllocatedBytesForCurrentThread();
        LocalizerFrame frame = frames[i % 3];
        frame.ColorTimeNs = frame.DepthTimeNs = 1000000000L * (i + 1);
        localizer.Process(frame, out result);
        localizer.Predict(frame.ColorTimeNs, out prediction);
        localizer.Extract(frame, features);
        localizer.Locate(frame, features, out result);
      }
      Expect.Equal(0L, GC.GetAllocatedBytesForCurrentThread() - before, "bytes allocated in nine frames");
    }
  }

  private static bool Alive(Map map) {
    return map.Handle.HasMemory;
  }

  private static void Collect() {
    for (int i = 0; i < 2; ++i) {
      GC.Collect();
      GC.WaitForPendingFinalizers();
    }
  }
}
