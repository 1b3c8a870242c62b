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
    lock (gate) {
      stopped = true;
      Monitor.PulseAll(gate);
    }
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
      uint index;
      lock (gate) {
        if (next == count) break;
        index = Take();
      }
      Do(called, dataOfPieces, index);
    }
    lock (gate) {
      while (running > 0) Monitor.Wait(gate);
      inUse = false;
    }
  }

  private bool Begin(uint pieces, IntPtr function, IntPtr dataOfPieces, out Piece called) {
    lock (gate) {
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
    lock (gate)
      if (--running == 0 && next == count) Monitor.PulseAll(gate);
  }
}
}
