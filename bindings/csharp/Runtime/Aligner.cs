using System;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Shows whole depth images as the colour camera would see them. One call at a time for each aligner.</summary>
public sealed unsafe class Aligner : IDisposable {
  private readonly AlignerHandle handle;
  private readonly int width, height;

  /// <summary>Takes its memory here, once. Throws SpherecloudException where the config cannot be used. Any
  /// thread.</summary>
  public Aligner(AlignerConfig config) {
    if (config == null) throw new ArgumentNullException(nameof(config));
    handle = new AlignerHandle(config);
    width = (int)config.Rig.ColorCamera.Width;
    height = (int)config.Rig.ColorCamera.Height;
  }

  /// <summary>Aligns a depth image. Each output may be null, else it has room for the colour camera's width x height
  /// pixels, closely packed: depth in config.AlignedUnitM (0: none), values of AlignedPixel, and confidence, where 255
  /// is exact and 0 no depth. Throws SpherecloudException where the image does not fit the config. One call at a
  /// time.</summary>
  public void Process(ImageData depth, ushort[] aligned, byte[] mask = null, byte[] confidence = null) {
    RequireRoom(aligned, nameof(aligned));
    RequireRoom(mask, nameof(mask));
    RequireRoom(confidence, nameof(confidence));
    fixed (ushort* alignedAt = aligned)
    fixed (byte* maskAt = mask)
    fixed (byte* confidenceAt = confidence)
      Process(depth, (IntPtr)alignedAt, (IntPtr)maskAt, (IntPtr)confidenceAt);
  }

  /// <summary>The same into native memory, whose extent cannot be checked.</summary>
  public void Process(ImageData depth, IntPtr aligned, IntPtr mask, IntPtr confidence) {
    var into = new Native.sphc_aligned {
      struct_size = (uint)sizeof(Native.sphc_aligned), depth_stride_bytes = (uint)(2 * width),
      mask_stride_bytes = (uint)width, confidence_stride_bytes = (uint)width,
      depth = (ushort*)aligned, mask = (byte*)mask, confidence = (byte*)confidence};
    Native.sphc_image image;
    GCHandle pin = default(GCHandle);
    using (var use = handle.Enter(Lane.Main)) try {
      pin = depth.Lend(&image);
      var aligner = (Native.sphc_aligner*)use.Instance;
      Status status = Native.sphc_aligner_process(aligner, &image, &into);
      if (status < 0) throw new SpherecloudException(status, Text.Of(Native.sphc_aligner_message(aligner)));
    } finally {
      if (pin.IsAllocated) pin.Free();
    }
  }

  /// <summary>Frees the memory, once a call that is under way has ended.</summary>
  public void Dispose() {
    handle.Dispose();
  }

  private void RequireRoom(Array pixels, string name) {
    if (pixels != null && pixels.Length < (long)width * height)
      throw new ArgumentException("needs " + width + " x " + height + " elements and has " + pixels.Length, name);
  }
}

internal sealed unsafe class AlignerHandle : NativeHandle {
  internal AlignerHandle(AlignerConfig config) : base("Aligner") {
    Native.sphc_aligner_config raw = config.raw;
    Native.sphc_memory need;
    Native.sphc_aligner* aligner = null;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_aligner_memory(&raw, &need, &message), ref message);
    AlignedMemory state = Allocate(need.state_bytes, need.alignment);
    Status status = Native.sphc_aligner_init(state.Start, Size.Of(state.Bytes), &raw, &aligner, &message);
    Adopt(aligner, status, ref message);
  }

  protected override void End(void* instance) {
    var aligner = (Native.sphc_aligner*)instance;
    Native.sphc_aligner_fini(&aligner);
  }
}
}
