using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Threading;

namespace SphereCloud {
/// <summary>Memory of the process at an alignment.</summary>
internal unsafe struct AlignedMemory {
  private readonly IntPtr block;
  internal readonly byte* Start;
  internal readonly long Bytes;

  internal AlignedMemory(ulong bytes, uint alignment) {
    Bytes = (long)bytes;
    block = Marshal.AllocHGlobal((IntPtr)(Bytes + alignment));
    Start = (byte*)(((ulong)block + alignment - 1) / alignment * alignment);
    GC.AddMemoryPressure(Bytes);
  }

  internal void Free() {
    Marshal.FreeHGlobal(block);
    GC.RemoveMemoryPressure(Bytes);
  }
}

/// <summary>Which calls of an object exclude each other.</summary>
[Flags]
internal enum Lane { None = 0, Main = 1, Extract = 2 }

/// <summary>An instance of the library with its memory. It lives until it was disposed of, or forgotten, and every call
/// and every object that uses it has ended.</summary>
internal abstract unsafe class NativeHandle : SafeHandle {
  private const int Reader = 4;  // above the lanes
  private readonly string name;
  private readonly List<AlignedMemory> memory = new List<AlignedMemory>(2);
  private int busy;
  private volatile bool disposed;

  protected NativeHandle(string name) : base(IntPtr.Zero, true) {
    this.name = name;
  }

  public sealed override bool IsInvalid { get { return handle == IntPtr.Zero; } }

  protected AlignedMemory Allocate(ulong bytes, uint alignment) {
    try {
      memory.Add(new AlignedMemory(Math.Max(bytes, 1), alignment));
    } catch {
      Abandon();
      throw;
    }
    return memory[memory.Count - 1];
  }

  /// <summary>Where an instance could not be made, its memory goes at once.</summary>
  protected void Adopt(void* instance, Status status, ref Native.sphc_message message) {
    SetHandle((IntPtr)instance);
    if (status < 0) Abandon();
    SpherecloudException.Check(status, ref message);
  }

  /// <summary>For a constructor that fails between Allocate and Adopt: nothing else frees what it has allocated.</summary>
  protected void Abandon() {
    SetHandleAsInvalid();
    ReleaseHandle();
  }

  /// <summary>IsClosed stays false as long as anyone uses the instance, and new calls are to be refused before that.</summary>
  protected override void Dispose(bool disposing) {
    disposed = true;
    base.Dispose(disposing);
  }

  internal bool HasMemory { get { return memory.Count > 0; } }

  /// <summary>Ends the instance, which may be null.</summary>
  protected abstract void End(void* instance);

  protected sealed override bool ReleaseHandle() {
    End((void*)handle);
    foreach (AlignedMemory piece in memory) piece.Free();
    memory.Clear();
    return true;
  }

  /// <summary>Keeps the instance alive, and other threads out of the same lanes, until the use is disposed of.</summary>
  internal Use Enter(Lane lanes) {
    return new Use(this, lanes, (int)lanes);
  }

  /// <summary>The same beside other readers, but beside no one in a lane.</summary>
  internal Use Read() {
    return new Use(this, Lane.Main | Lane.Extract, Reader);
  }

  /// <summary>For another object that uses this one for longer than a call.</summary>
  internal void Keep() {
    bool kept = false;
    if (disposed || IsClosed || IsInvalid) throw Closed();
    DangerousAddRef(ref kept);
  }

  private ObjectDisposedException Closed() {
    return new ObjectDisposedException(name, "this " + name + " was disposed of; make another");
  }

  /// <summary>Those in lanes exclude readers, and readers those in lanes.</summary>
  private void Claim(Lane free, int mark) {
    for (;;) {
      int seen = busy;
      bool shut = (seen & (int)free) != 0 || (free != Lane.None && mark < Reader && seen >= Reader);
      if (shut) throw new InvalidOperationException(
          "another thread, or a callback, uses this " + name + "; one call at a time, or one " + name + " for each thread");
      if (Interlocked.CompareExchange(ref busy, seen + mark, seen) == seen) return;
    }
  }

  /// <summary>One call.</summary>
  internal struct Use : IDisposable {
    private readonly NativeHandle owner;
    private readonly int mark;

    internal Use(NativeHandle owner, Lane free, int mark) {
      owner.Keep();
      this.owner = owner;
      this.mark = mark;
      try {
        owner.Claim(free, mark);
      } catch {
        owner.DangerousRelease();
        throw;
      }
    }

    internal void* Instance { get { return (void*)owner.handle; } }

    public void Dispose() {
      Interlocked.Add(ref owner.busy, -mark);
      owner.DangerousRelease();
    }
  }
}
}
