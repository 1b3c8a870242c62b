using System;
using System.IO;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>A map file that was read and checked. It never changes, so any number of localizers and threads may use it.
/// Its memory stays as long as a localizer has the map, even where it was disposed of.</summary>
public sealed unsafe class Map : IDisposable {
  internal readonly MapHandle Handle;

  private Map(MapHandle handle) {
    Handle = handle;
  }

  /// <summary>Reads and checks a file, about 1 ms a MB. Throws the exceptions of File.OpenRead, and SpherecloudException
  /// where the file is no map of this library. Any thread.</summary>
  public static Map Open(string path) {
    Library.Require();
    using (FileStream file = File.OpenRead(path)) return new Map(new MapHandle(file));
  }

  /// <summary>Checks a map that is in memory, such as a downloaded one or a Unity TextAsset. The bytes are copied. Throws
  /// SpherecloudException where they are no map of this library. Any thread.</summary>
  public static Map FromBytes(byte[] bytes) {
    if (bytes == null) throw new ArgumentNullException(nameof(bytes));
    Library.Require();
    return new Map(new MapHandle(new MemoryStream(bytes, false)));
  }

  /// <summary>What the map says of itself. Any thread.</summary>
  public MapInfo Info {
    get {
      MapInfo info;
      using (Handle.Enter(Lane.None)) Read(&info);
      return info;
    }
  }

  /// <summary>The unit direction of a point from the centre of the map, in the map's frame. Points count from 0. Throws
  /// SpherecloudException where there is no such point. Any thread.</summary>
  public Vector3d Direction(int pointIndex) {
    Vector3d direction;
    using (Handle.Enter(Lane.None)) {
      Status status = Native.sphc_map_direction(Handle.Pointer, (uint)pointIndex, (double*)&direction);
      if (status < 0) throw NoPoint(status, pointIndex);
    }
    return direction;
  }

  private SpherecloudException NoPoint(Status status, int pointIndex) {
    MapInfo info;
    Read(&info);
    return new SpherecloudException(
        status, "pointIndex is " + pointIndex + "; give 0 to " + (info.PointCount - 1L) + ", as the map has " +
                info.PointCount + " points");
  }

  /// <summary>Inside a call.</summary>
  private void Read(MapInfo* info) {
    *info = new MapInfo { struct_size = (uint)sizeof(MapInfo) };
    SpherecloudException.Check(Native.sphc_map_get_info(Handle.Pointer, info));
  }

  /// <summary>Lets the map go. Localizers that have it keep it.</summary>
  public void Dispose() {
    Handle.Dispose();
  }
}

public unsafe partial struct MapInfo {
  /// <summary>The name of this release of the map, by what it holds, 32 hexadecimal digits.</summary>
  public string BuildName {
    get {
      var digits = new System.Text.StringBuilder(32);
      fixed (byte* first = map_id)
        for (int i = 0; i < 16; ++i) digits.Append(first[i].ToString("x2"));
      return digits.ToString();
    }
  }
}

internal sealed unsafe class MapHandle : NativeHandle {
  private const int Alignment = 64;

  internal MapHandle(Stream file) : base("Map") {
    Native.sphc_memory need;
    SpherecloudException.Check(Native.sphc_map_memory(&need));
    AlignedMemory bytes = Allocate((ulong)file.Length, Alignment), view = Allocate(need.state_bytes, need.alignment);
    try {
      Fill(bytes.Start, file);
    } catch {
      Abandon();
      throw;
    }
    Native.sphc_map* map = null;
    var message = new Native.sphc_message();
    Status status = Native.sphc_map_init(view.Start, Size.Of(view.Bytes), bytes.Start, Size.Of(file.Length), &map, &message);
    Adopt(map, status, ref message);
  }

  internal Native.sphc_map* Pointer { get { return (Native.sphc_map*)handle; } }

  private static void Fill(byte* to, Stream file) {
    var piece = new byte[65536];
    for (long filled = 0; filled < file.Length;) {
      int read = file.Read(piece, 0, (int)Math.Min(piece.Length, file.Length - filled));
      if (read == 0) throw new EndOfStreamException("the map file became shorter while it was read");
      Marshal.Copy(piece, 0, (IntPtr)(to + filled), read);
      filled += read;
    }
  }

  protected override void End(void* instance) {
    var map = (Native.sphc_map*)instance;
    Native.sphc_map_fini(&map);
  }
}
}
