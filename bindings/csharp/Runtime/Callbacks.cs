using System;
using System.Diagnostics;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Marks what native code calls, for compilers that translate ahead of time: they know it by its name.</summary>
[AttributeUsage(AttributeTargets.Method)]
internal sealed class MonoPInvokeCallbackAttribute : Attribute {
  public MonoPInvokeCallbackAttribute(Type type) {}
}

/// <summary>The log, the clock and the threads of one localizer, and the way from native code to them.</summary>
internal sealed unsafe class Callbacks {
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  private delegate void LogFunction(IntPtr user, LogLevel level, IntPtr text, UIntPtr length);
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  private delegate long ClockFunction(IntPtr user);
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  private delegate void ParallelFunction(IntPtr user, uint count, IntPtr task, IntPtr taskData);

  // These live as long as the program, as native code points to them.
  private static readonly LogFunction log = OnLog;
  private static readonly ClockFunction clock = OnClock;
  private static readonly ParallelFunction parallel = OnParallel;
  [ThreadStatic] private static Exception thrown;

  private readonly Action<LogLevel, string> logTo;
  private readonly Func<long> clockNs;
  private readonly WorkerPool workers;

  internal Callbacks(LocalizerConfig config) {
    logTo = config.Log;
    clockNs = config.Clock;
    if (config.ParallelTasks > 1) workers = new WorkerPool(config.ParallelTasks - 1);
  }

  /// <summary>Without it a config with tasks is refused.</summary>
  internal static IntPtr Parallel { get { return Marshal.GetFunctionPointerForDelegate(parallel); } }

  internal void Stop() {
    if (workers != null) workers.Stop();
  }

  /// <summary>`self` is a handle of this object.</summary>
  internal void Fill(Native.sphc_localizer_config* config, GCHandle self) {
    config->log_user = config->clock_user = config->parallel_user = (void*)GCHandle.ToIntPtr(self);
    config->log = logTo != null ? Marshal.GetFunctionPointerForDelegate(log) : IntPtr.Zero;
    config->clock = clockNs != null ? Marshal.GetFunctionPointerForDelegate(clock) : IntPtr.Zero;
  }

  /// <summary>Exceptions cannot pass native code: the call that they were thrown in throws them at its end.</summary>
  internal static void Rethrow() {
    Exception caught = thrown;
    if (caught == null) return;
    thrown = null;
    System.Runtime.ExceptionServices.ExceptionDispatchInfo.Capture(caught).Throw();
  }

  [MonoPInvokeCallback(typeof(LogFunction))]
  private static void OnLog(IntPtr user, LogLevel level, IntPtr text, UIntPtr length) {
    try {
      ((Callbacks)GCHandle.FromIntPtr(user).Target).logTo(level, Text.Of((byte*)text));
    } catch (Exception caught) {
      thrown = caught;
    }
  }

  [MonoPInvokeCallback(typeof(ParallelFunction))]
  private static void OnParallel(IntPtr user, uint count, IntPtr task, IntPtr taskData) {
    ((Callbacks)GCHandle.FromIntPtr(user).Target).workers.Run(count, task, taskData);
  }

  [MonoPInvokeCallback(typeof(ClockFunction))]
  private static long OnClock(IntPtr user) {
    try {
      return ((Callbacks)GCHandle.FromIntPtr(user).Target).clockNs();
    } catch (Exception caught) {
      thrown = caught;
      return 0;
    }
  }
}

/// <summary>A clock that only goes forward.</summary>
public static class MonotonicClock {
  private static readonly double nsPerTick = 1e9 / Stopwatch.Frequency;
  private static readonly long wholeNsPerTick = 1000000000 / Stopwatch.Frequency;

  /// <summary>Nanoseconds since some moment. Any thread.</summary>
  public static long NowNs() {
    long ticks = Stopwatch.GetTimestamp();
    return nsPerTick == wholeNsPerTick ? ticks * wholeNsPerTick : (long)(ticks * nsPerTick);
  }
}
}
