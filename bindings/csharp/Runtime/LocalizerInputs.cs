using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace SphereCloud {
public sealed unsafe partial class LocalizerConfig {
  /// <summary>Gets lines of the log, on the thread of the call that writes them; null: no log. What it throws, that call
  /// throws at its end. It must not call the same localizer.</summary>
  public Action<LogLevel, string> Log { get; set; }

  /// <summary>Nanoseconds of a clock that only goes forward. Stage times and deadlines need it; null: there are none. At
  /// first MonotonicClock.NowNs. With Features it is called by several threads.</summary>
  public Func<long> Clock { get; set; } = MonotonicClock.NowNs;

  /// <summary>How many threads work on a frame, the calling one among them: 1 to Limits.ParallelMax. A localizer starts the
  /// others when it is made, and they end with it. Results are the same to the last bit, where no deadline is set. With
  /// more than one, they may call Clock too; what it throws there is dropped.</summary>
  public uint ParallelTasks { get; set; } = 1;

  /// <summary>The rig's further cameras, in the order of LocalizerFrame.Views. At most Limits.CamerasMax - 1.</summary>
  public List<LocalizerCamera> Cameras { get; } = new List<LocalizerCamera>();

  /// <summary>The rig's further depth cameras, in the order of LocalizerFrame.DepthViews. At most
  /// Limits.DepthCamerasMax - 1.</summary>
  public List<LocalizerDepthCamera> DepthCameras { get; } = new List<LocalizerDepthCamera>();

  /// <summary>Bytes of memory that a localizer of this config takes, piece by piece. Throws SpherecloudException where
  /// the config cannot be used.</summary>
  public List<MemoryPiece> MemoryPieces() {
    var pieces = new List<MemoryPiece>();
    long* room = stackalloc long[CameraLongs];
    Native.sphc_localizer_config borrowed = Borrow(room);
    Native.sphc_memory whole;
    var message = new Native.sphc_message();
    // Pieces come without a message; the whole has one.
    SpherecloudException.Check(Native.sphc_localizer_memory(&borrowed, &whole, &message), ref message);
    for (;;) {
      Native.sphc_memory_piece piece;
      Status status = Native.sphc_localizer_memory_piece(&borrowed, (uint)pieces.Count, &piece);
      SpherecloudException.Check(status);
      if (status == Status.End) return pieces;
      pieces.Add(new MemoryPiece(Text.Of(piece.name), (long)piece.bytes, piece.scratch != 0));
    }
  }

  private const int MaxCameras = Limits.CamerasMax - 1, MaxDepthCameras = Limits.DepthCamerasMax - 1;

  /// <summary>Room for the further cameras; of long, for its alignment.</summary>
  internal static readonly int CameraLongs =
      (MaxCameras * sizeof(Native.sphc_localizer_camera) + MaxDepthCameras * sizeof(Native.sphc_localizer_depth_camera)) /
      sizeof(long) + 1;

  /// <summary>For one call; without log and clock. `room` is of CameraLongs.</summary>
  internal Native.sphc_localizer_config Borrow(long* room) {
    if (Cameras.Count > MaxCameras)
      throw new ArgumentException("config.Cameras has " + Cameras.Count + "; at most " + MaxCameras);
    if (DepthCameras.Count > MaxDepthCameras)
      throw new ArgumentException("config.DepthCameras has " + DepthCameras.Count + "; at most " + MaxDepthCameras);
    Native.sphc_localizer_config borrowed = raw;
    if (ParallelTasks != 1) {
      borrowed.parallel = Callbacks.Parallel;
      borrowed.parallel_tasks = ParallelTasks;
    }
    var cameras = (Native.sphc_localizer_camera*)room;
    borrowed.camera_count = (uint)Cameras.Count;
    borrowed.cameras = Cameras.Count > 0 ? cameras : null;
    for (int i = 0; i < Cameras.Count; ++i)
      cameras[i] = Entries.Require(Cameras[i], "config.Cameras", i, "put a LocalizerCamera there").raw;
    var depthCameras = (Native.sphc_localizer_depth_camera*)(cameras + MaxCameras);
    borrowed.depth_camera_count = (uint)DepthCameras.Count;
    borrowed.depth_cameras = DepthCameras.Count > 0 ? depthCameras : null;
    for (int i = 0; i < DepthCameras.Count; ++i)
      depthCameras[i] = Entries.Require(DepthCameras[i], "config.DepthCameras", i, "put a LocalizerDepthCamera there").raw;
    return borrowed;
  }
}

/// <summary>Entries of the lists of configs and frames.</summary>
internal static class Entries {
  /// <summary>A null reference that reaches unsafe code can end the program, so it is refused before.</summary>
  internal static T Require<T>(T entry, string list, int index, string cure) where T : class {
    if (entry == null) throw new ArgumentException(list + "[" + index + "] is null; " + cure + ", or remove the entry");
    return entry;
  }
}

/// <summary>A named piece of a localizer's memory.</summary>
public readonly struct MemoryPiece {
  internal MemoryPiece(string name, long bytes, bool isScratch) {
    Name = name;
    Bytes = bytes;
    IsScratch = isScratch;
  }

  /// <summary>What it is for, such as "features.pyramid".</summary>
  public string Name { get; }
  /// <summary>Its size.</summary>
  public long Bytes { get; }
  /// <summary>True where nothing is kept in it from one frame to the next.</summary>
  public bool IsScratch { get; }
}

public sealed unsafe partial class LocalizerView {
  /// <summary>In any format that is not of depth. Unset: the camera has none in this frame.</summary>
  public ImageData Image { get; set; }

  /// <summary>The camera as it is in this frame, with heat or focus; null: as in the config. The size stays.</summary>
  public CameraIntrinsics? Camera { get; set; }

  /// <summary>The camera's place in this frame; null: as in the config.</summary>
  public Rigid? ColorFromCamera { get; set; }
}

public sealed unsafe partial class LocalizerDepthView {
  /// <summary>In the camera's format and size. Unset: the camera has none in this frame.</summary>
  public ImageData Depth { get; set; }

  /// <summary>As LocalizerFrame.Amplitude. Every depth image has one where the camera's AmplitudeMin is set.</summary>
  public ImageData Amplitude { get; set; }

  /// <summary>The camera as it is in this frame, with heat or focus; null: as in the config. The size stays.</summary>
  public CameraIntrinsics? Camera { get; set; }

  /// <summary>The camera's place in this frame; null: as in the config.</summary>
  public Rigid? ColorFromDepth { get; set; }
}

/// <remarks>One frame can be changed and used again for the next; a call keeps nothing of it.</remarks>
public sealed unsafe partial class LocalizerFrame {
  /// <summary>In any format that is not of depth; the size is that of config.Rig.ColorCamera.</summary>
  public ImageData Color { get; set; }

  /// <summary>In config.DepthFormat; the size is that of config.Rig.DepthCamera.</summary>
  public ImageData Depth { get; set; }

  /// <summary>How much of its own light the depth sensor saw in each pixel, or how sure it is of it: Gray8, Gray10,
  /// Gray12 or Gray16, of the depth image's size. Every frame has one where config.AmplitudeMin is set.</summary>
  public ImageData Amplitude { get; set; }

  /// <summary>What is known of the pose beforehand; null: nothing but what earlier frames told.</summary>
  public LocalizerPrior Prior { get; set; }

  /// <summary>The images of config.Cameras, in their order.</summary>
  public List<LocalizerView> Views { get; } = new List<LocalizerView>();

  /// <summary>The colour camera as it is in this frame; null: as in config.Rig. The size stays.</summary>
  public CameraIntrinsics? ColorCamera { get; set; }

  /// <summary>The depth camera's place in this frame; null: as in config.Rig.</summary>
  public Rigid? ColorFromDepth { get; set; }

  /// <summary>The depth camera as it is in this frame; null: as in config.Rig. The size stays. Of a Range format, cosines
  /// stay those of config.Rig.</summary>
  public CameraIntrinsics? DepthCamera { get; set; }

  /// <summary>The images of config.DepthCameras, in their order.</summary>
  public List<LocalizerDepthView> DepthViews { get; } = new List<LocalizerDepthView>();
}

/// <summary>A frame as C wants it, for one call: arrays are pinned until it is disposed of. Everything lies in the
/// caller's block, so nothing is allocated.</summary>
internal unsafe struct LentFrame : IDisposable {
  private const int MaxViews = Limits.CamerasMax - 1, MaxDepthViews = Limits.DepthCamerasMax - 1;
  private const string EmptyView = "put a LocalizerView there, without an image where its camera has none";
  private const string EmptyDepthView = "put a LocalizerDepthView there, without an image where its camera has none";
  private const int MaxPins = 3 + MaxViews + 2 * MaxDepthViews;

  private struct Block {
    internal Native.sphc_localizer_frame frame;
    internal Native.sphc_localizer_prior prior;
    internal CameraIntrinsics camera;
    internal Rigid rigid;
    internal CameraIntrinsics depthCamera;
  }

  private struct ViewBlock {
    internal CameraIntrinsics camera;
    internal Rigid rigid;
  }

  /// <summary>Room for a block, a ViewBlock of each view and depth view, the views and the depth views; of long, for its
  /// alignment.</summary>
  internal static readonly int Longs =
      (sizeof(Block) + MaxViews * (sizeof(Native.sphc_localizer_view) + sizeof(ViewBlock)) +
       MaxDepthViews * (sizeof(Native.sphc_localizer_depth_view) + sizeof(ViewBlock))) / sizeof(long) + 1;

  private fixed long pins[MaxPins];
  private int pinned;
  private readonly Block* block;

  internal LentFrame(LocalizerFrame frame, long* room) : this() {
    if (frame == null) throw new ArgumentNullException(nameof(frame));
    if (frame.Views.Count > MaxViews)
      throw new ArgumentException("frame.Views has " + frame.Views.Count + "; at most " + MaxViews);
    if (frame.DepthViews.Count > MaxDepthViews)
      throw new ArgumentException("frame.DepthViews has " + frame.DepthViews.Count + "; at most " + MaxDepthViews);
    block = (Block*)room;
    block->frame = frame.raw;
    if (frame.Prior != null) {
      block->prior = frame.Prior.raw;
      block->frame.prior = &block->prior;
    }
    block->frame.color_camera = Put(frame.ColorCamera, &block->camera);
    block->frame.color_from_depth = Put(frame.ColorFromDepth, &block->rigid);
    block->frame.depth_camera = Put(frame.DepthCamera, &block->depthCamera);
    try {
      Pin(frame.Color, &block->frame.color);
      Pin(frame.Depth, &block->frame.depth);
      Pin(frame.Amplitude, &block->frame.amplitude);
      PutViews(frame.Views);
      PutDepthViews(frame.DepthViews);
    } catch {
      Dispose();
      throw;
    }
  }

  internal Native.sphc_localizer_frame* Raw { get { return &block->frame; } }

  private void PutViews(List<LocalizerView> views) {
    var rest = (ViewBlock*)(block + 1);
    var raw = (Native.sphc_localizer_view*)(rest + MaxViews + MaxDepthViews);
    for (int i = 0; i < views.Count; ++i) {
      LocalizerView view = Entries.Require(views[i], "frame.Views", i, EmptyView);
      raw[i] = view.raw;
      raw[i].camera = Put(view.Camera, &rest[i].camera);
      raw[i].color_from_camera = Put(view.ColorFromCamera, &rest[i].rigid);
      Pin(view.Image, &raw[i].image);
    }
    block->frame.views = views.Count > 0 ? raw : null;
    block->frame.view_count = (uint)views.Count;
  }

  private void PutDepthViews(List<LocalizerDepthView> views) {
    ViewBlock* rest = (ViewBlock*)(block + 1) + MaxViews;
    var raw = (Native.sphc_localizer_depth_view*)((Native.sphc_localizer_view*)(rest + MaxDepthViews) + MaxViews);
    for (int i = 0; i < views.Count; ++i) {
      LocalizerDepthView view = Entries.Require(views[i], "frame.DepthViews", i, EmptyDepthView);
      raw[i] = view.raw;
      raw[i].camera = Put(view.Camera, &rest[i].camera);
      raw[i].color_from_depth = Put(view.ColorFromDepth, &rest[i].rigid);
      Pin(view.Depth, &raw[i].depth);
      Pin(view.Amplitude, &raw[i].amplitude);
    }
    block->frame.depth_views = views.Count > 0 ? raw : null;
    block->frame.depth_view_count = (uint)views.Count;
  }

  private static CameraIntrinsics* Put(CameraIntrinsics? camera, CameraIntrinsics* to) {
    if (camera == null) return null;
    *to = camera.GetValueOrDefault();
    return to;
  }

  private static Rigid* Put(Rigid? rigid, Rigid* to) {
    if (rigid == null) return null;
    *to = rigid.GetValueOrDefault();
    return to;
  }

  private void Pin(ImageData image, Native.sphc_image* to) {
    GCHandle pin = image.Lend(to);
    fixed (long* first = pins)
      if (pin.IsAllocated) first[pinned++] = (long)GCHandle.ToIntPtr(pin);
  }

  public void Dispose() {
    fixed (long* first = pins)
      while (pinned > 0) GCHandle.FromIntPtr((IntPtr)first[--pinned]).Free();
  }
}
}
