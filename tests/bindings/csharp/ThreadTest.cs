using System;
using System.Threading;
using SphereCloud;

internal static class ThreadTest {
  /// <summary>One map, a localizer for each thread: all find the same.</summary>
  public static void LocalizersRunBesideEachOther() {
    var localized = new int[3];
    using (Map map = Map.Open(Session.MapPath))
      Together(localized.Length, i => {
        using (var localizer = new Localizer(Session.Config())) {
          localizer.SetMap(Session.MapId, map);
          for (int frame = 0; frame < 4; ++frame)
            if (GoldenTest.Compare(localizer, frame)) ++localized[i];
        }
      });
    foreach (int count in localized) Expect.True(count > 0, "frames are localized");
  }

  /// <summary>The features of the next frame are found while this one is located.</summary>
  public static void HalvesRunBesideEachOther() {
    LocalizerConfig config = Session.Config();
    config.ParallelTasks = 2;
    using (Localizer localizer = Session.Localizer(config), alone = Session.Localizer())
    using (Features even = new Features(config), odd = new Features(config)) {
      Features[] both = {even, odd};
      LocalizerFrame[] frames = {Session.Frame(0), Session.Frame(1), Session.Frame(2), Session.Frame(3)};
      localizer.Extract(frames[0], even);
      for (int i = 0; i + 1 < frames.Length; ++i) {
        LocalizerResult located = default(LocalizerResult), wanted;
        Together(2, half => {
          if (half == 0) localizer.Locate(frames[i], both[i % 2], out located);
          else localizer.Extract(frames[i + 1], both[(i + 1) % 2]);
        });
        Expect.True(alone.Process(frames[i], out wanted), "a frame is localized");
        Expect.Numbers(Session.Numbers(wanted.CameraFromMap), Session.Numbers(located.CameraFromMap), "pose");
      }
    }
  }

  /// <summary>Native code cannot be thrown through: the interrupt is there when the call is over, and the threads work
  /// on.</summary>
  public static void AnInterruptWaitsForTheEndOfTheCall() {
    LocalizerConfig config = Session.Config();
    config.ParallelTasks = 4;
    LocalizerFrame frame = Session.Frame(0);
    using (Localizer localizer = Session.Localizer(config), alone = Session.Localizer()) {
      LocalizerResult found = default(LocalizerResult), wanted = default(LocalizerResult);
      Together(1, i => {
        for (int call = 0; call < 20; ++call) {
          localizer.Reset();
          Thread.CurrentThread.Interrupt();
          Expect.True(localizer.Process(frame, out found), "a frame is localized");
          Expect.Throws<ThreadInterruptedException>(() => Thread.Sleep(1), "");
        }
      });
      for (int call = 0; call < 20; ++call) {
        alone.Reset();
        Expect.True(alone.Process(frame, out wanted), "a frame is localized");
      }
      Expect.Numbers(Session.Numbers(wanted.CameraFromMap), Session.Numbers(found.CameraFromMap), "pose");
    }
  }

  public static void ASecondCallAtTheSameTimeIsRefused() {
    using (var clock = new HeldClock())
    using (Localizer localizer = Session.Localizer(clock.Config())) {
      LocalizerResult result;
      clock.Meanwhile(() => localizer.Process(Session.Frame(0), out result), () => {
        LocalizerResult other;
        Expect.Throws<InvalidOperationException>(() => localizer.Process(Session.Frame(0), out other), "another thread");
        Expect.Throws<InvalidOperationException>(() => localizer.Reset(), "Localizer");
      });
      Expect.True(localizer.Process(Session.Frame(1), out result), "goes on");
    }
  }

  /// <summary>The call that is under way ends as it would, and no other begins.</summary>
  public static void WhatIsDisposedOfDuringACallIsClosedAtOnce() {
    LocalizerFrame frame = Session.Frame(0);
    using (var clock = new HeldClock())
    using (Localizer localizer = Session.Localizer(clock.Config()))
    using (Features features = new Features(Session.Config()))
      clock.Meanwhile(() => localizer.Extract(frame, features), () => {
        localizer.Dispose();
        features.Dispose();
        Expect.Throws<ObjectDisposedException>(() => localizer.Reset(), "Localizer");
        Expect.Throws<ObjectDisposedException>(() => localizer.Extract(frame, features), "Localizer");
        Expect.Throws<ObjectDisposedException>(() => features.Read(), "Features");
      });
  }

  public static void OnlyProcessAndExtractWaitForExtract() {
    LocalizerFrame frame = Session.Frame(0);
    using (var clock = new HeldClock())
    using (Localizer localizer = Session.Localizer(clock.Config()))
    using (Features filled = new Features(Session.Config()), other = new Features(Session.Config()))
      clock.Meanwhile(() => localizer.Extract(frame, filled), () => {
        LocalizerResult result;
        Expect.Equal(1, localizer.MapCount, "maps");
        localizer.Reset();
        Expect.Throws<InvalidOperationException>(() => localizer.Process(frame, out result), "Localizer");
        Expect.Throws<InvalidOperationException>(() => localizer.Extract(frame, other), "Localizer");
        Expect.Throws<InvalidOperationException>(() => localizer.Locate(frame, filled, out result), "Features");
      });
  }

  public static void FeaturesAreNotFilledWhileTheyAreRead() {
    LocalizerFrame frame = Session.Frame(0);
    using (var clock = new HeldClock())
    using (Localizer held = Session.Localizer(clock.Config()), other = Session.Localizer())
    using (var features = new Features(Session.Config())) {
      LocalizerResult unused;
      other.Extract(frame, features);
      clock.Meanwhile(() => held.Locate(frame, features, out unused), () => {
        LocalizerResult result;
        Expect.Throws<InvalidOperationException>(() => other.Extract(frame, features), "Features");
        Expect.True(other.Locate(frame, features, out result), "reads at the same time");
      });
      other.Extract(frame, features);
    }
  }

  /// <summary>Holds a call where it asks for the time, so that others surely meet it.</summary>
  private sealed class HeldClock : IDisposable {
    private readonly ManualResetEventSlim inside = new ManualResetEventSlim(), goOn = new ManualResetEventSlim();

    internal LocalizerConfig Config() {
      LocalizerConfig config = Session.Config();
      config.Clock = () => {
        inside.Set();
        goOn.Wait();
        return MonotonicClock.NowNs();
      };
      return config;
    }

    internal void Meanwhile(Action held, Action others) {
      var thread = new Thread(() => held());
      thread.Start();
      inside.Wait();
      try {
        others();
      } finally {
        goOn.Set();
        thread.Join();
      }
    }

    public void Dispose() {
      inside.Dispose();
      goOn.Dispose();
    }
  }

  private static void Together(int count, Action<int> work) {
    Exception failure = null;
    var threads = new Thread[count];
    for (int i = 0; i < count; ++i) {
      int index = i;
      threads[i] = new Thread(() => {
        try {
          work(index);
        } catch (Exception thrown) {
          failure = thrown;
        }
      });
      threads[i].Start();
    }
    foreach (Thread thread in threads) thread.Join();
    if (failure != null) throw new Exception("in a thread: " + failure);
  }
}
