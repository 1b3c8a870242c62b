using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Threading;

namespace SphereCloud {
/// <summary>Threads of one localizer, which sleep between its pieces of work. They know nothing of the localizer, so it can
/// be forgotten.</summary>
internal sealed class WorkerPool {
  [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
  internal delegate void Piece(IntPtr data, uint index);

  private readonly object gate = new object();  // guards all that follows
  private readonly Dictionary<IntPtr, Piece> known = new Dictionary<IntPtr, Piece>();
  private Piece piece;
  private IntPtr data;
  private uint next, count, running;
  private bool inUse, stopped;

  internal WorkerPool(uint threads) {
    for (uint i = 0; i < threads; ++i) new Thread(Work) { IsBackground = true, Name = "SphereCloud" }.Start();
  }

  internal void Stop() {
    Enter();
    stopped = true;
    Monitor.PulseAll(gate);
    Monitor.Exit(gate);
  }

  /// <summary>Runs all pieces, with the calling thread's help. Where the threads are at the work of another call, the
  /// calling thread does it alone.</summary>
  internal void Run(uint pieces, IntPtr function, IntPtr dataOfPieces) {
    Piece called;
    if (!Begin(pieces, function, dataOfPieces, out called)) {
      for (uint i = 0; i < pieces; ++i) called(dataOfPieces, i);
      return;
    }
    for (;;) {
      Enter();
      if (next == count) break;
      uint index = Take();
      Monitor.Exit(gate);
      Do(called, dataOfPieces, index);
    }
    WaitForOthers();
    inUse = false;
    Monitor.Exit(gate);
  }

  /// <summary>As the beginning of `lock (gate)`, but does not throw where the thread is interrupted, as native code called
  /// it; the next wait of the program's throws.</summary>
  private void Enter() {
    bool entered = false, interrupted = false;
    while (!entered) try {
        Monitor.Enter(gate, ref entered);
      } catch (ThreadInterruptedException) {
        interrupted = true;
      }
    if (interrupted) Thread.CurrentThread.Interrupt();
  }

  /// <summary>Inside the gate. Does not throw either.</summary>
  private void WaitForOthers() {
    bool interrupted = false;
    while (running > 0) try {
        Monitor.Wait(gate);
      } catch (ThreadInterruptedException) {
        interrupted = true;
      }
    if (interrupted) Thread.CurrentThread.Interrupt();
  }

  private bool Begin(uint pieces, IntPtr function, IntPtr dataOfPieces, out Piece called) {
    Enter();
    try {
      if (!known.TryGetValue(function, out called)) {
        called = (Piece)Marshal.GetDelegateForFunctionPointer(function, typeof(Piece));
        known[function] = called;
      }
      if (inUse) return false;
      inUse = true;
      piece = called;
      data = dataOfPieces;
      next = 0;
      count = pieces;
      Monitor.PulseAll(gate);
      return true;
    } finally {
      Monitor.Exit(gate);
    }
  }

  private void Work() {
    for (;;) {
      Piece called;
      IntPtr dataOfPieces;
      uint index;
      lock (gate) {
        while (next == count && !stopped) Monitor.Wait(gate);
        if (stopped) return;
        called = piece;
        dataOfPieces = data;
        index = Take();
      }
      Do(called, dataOfPieces, index);
    }
  }

  /// <summary>Inside the gate.</summary>
  private uint Take() {
    ++running;
    return next++;
  }

  private void Do(Piece called, IntPtr dataOfPieces, uint index) {
    called(dataOfPieces, index);
    Enter();
    if (--running == 0 && next == count) Monitor.PulseAll(gate);
    Monitor.Exit(gate);
  }
}
}
