using System;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>What a colour image shows, between the two halves of a frame: Localizer.Extract and Localizer.Locate. Filled
/// and filled again; several localizers may locate the same features at the same time.</summary>
public sealed unsafe class Features : IDisposable {
  internal readonly FeaturesHandle Handle;

  /// <summary>For localizers of this config. Takes its memory here, once. Throws SpherecloudException where the config
  /// cannot be used. Any thread.</summary>
  public Features(LocalizerConfig config) {
    if (config == null) throw new ArgumentNullException(nameof(config));
    Handle = new FeaturesHandle(config);
  }

  /// <summary>Puts in features that other hardware has found, the strongest response first. Of the frame, Color and
  /// ColorTimeNs are read. Everything is copied. Throws SpherecloudException where they do not fit; then the features
  /// stay what they were. One call at a time.</summary>
  public void Set(LocalizerFrame frame, FeatureArrays arrays) {
    if (arrays == null) throw new ArgumentNullException(nameof(arrays));
    arrays.RequireRoom();
    long* room = stackalloc long[LentFrame.Longs];
    using (var use = Handle.Enter(Lane.Main))
    using (var lent = new LentFrame(frame, room))
    fixed (Keypoint* keypoints = arrays.Keypoints)
    fixed (byte* descriptors = arrays.Descriptors)
    fixed (byte* cameras = arrays.Cameras) {
      var raw = new Native.sphc_features_arrays {
        struct_size = (uint)sizeof(Native.sphc_features_arrays), extractor = arrays.Extractor,
        count = (uint)arrays.Keypoints.Length, keypoint_stride_bytes = (uint)sizeof(Keypoint),
        descriptor_stride_bytes = Native.DescriptorBytes, keypoints = keypoints, descriptors = descriptors,
        cameras = cameras};
      var features = (Native.sphc_features*)use.Instance;
      Check(features, Native.sphc_features_set(features, lent.Raw, &raw));
    }
  }

  /// <summary>Copies them out. Throws SpherecloudException where they are of no frame yet. May run beside other reads and
  /// Localizer.Locate.</summary>
  public FeatureArrays Read() {
    var raw = new Native.sphc_features_arrays { struct_size = (uint)sizeof(Native.sphc_features_arrays) };
    using (var use = Handle.Read()) {
      Status status = Native.sphc_features_get((Native.sphc_features*)use.Instance, &raw);
      if (status == Status.State) throw new SpherecloudException(
          status, "the features are of no frame yet; call Localizer.Extract or Features.Set first");
      SpherecloudException.Check(status);
      return new FeatureArrays(&raw);
    }
  }

  /// <summary>Frees the memory, once a call that is under way has ended.</summary>
  public void Dispose() {
    Handle.Dispose();
  }

  internal static void Check(Native.sphc_features* features, Status status) {
    if (status < 0) throw new SpherecloudException(status, Text.Of(Native.sphc_features_message(features)));
  }
}

/// <summary>Keypoints with their descriptors.</summary>
public sealed unsafe class FeatureArrays {
  /// <summary>Bytes of a descriptor.</summary>
  public const int DescriptorBytes = Native.DescriptorBytes;

  /// <summary>Which extractor described them; at first Library.ExtractorId.</summary>
  public uint Extractor { get; set; }

  /// <summary>The strongest response first.</summary>
  public Keypoint[] Keypoints { get; set; } = new Keypoint[0];

  /// <summary>DescriptorBytes of each keypoint, one after the other.</summary>
  public byte[] Descriptors { get; set; } = new byte[0];

  /// <summary>The camera of each keypoint: 0 the colour camera, i config.Cameras[i - 1]; null: all of the colour
  /// camera.</summary>
  public byte[] Cameras { get; set; }

  /// <summary>None yet.</summary>
  public FeatureArrays() {
    Extractor = Library.ExtractorId;
  }

  internal FeatureArrays(Native.sphc_features_arrays* raw) {
    int count = (int)raw->count;
    Extractor = raw->extractor;
    Keypoints = new Keypoint[count];
    Descriptors = new byte[count * DescriptorBytes];
    if (raw->cameras != null) Cameras = new byte[count];
    for (int i = 0; i < count; ++i) {
      Keypoints[i] = *(Keypoint*)((byte*)raw->keypoints + (long)i * raw->keypoint_stride_bytes);
      byte* descriptor = raw->descriptors + (long)i * raw->descriptor_stride_bytes;
      Marshal.Copy((IntPtr)descriptor, Descriptors, i * DescriptorBytes, DescriptorBytes);
      if (Cameras != null) Cameras[i] = raw->cameras[i];
    }
  }

  internal void RequireRoom() {
    if (Keypoints == null || Descriptors == null) throw new ArgumentException("Keypoints and Descriptors are not null");
    if (Descriptors.Length < (long)Keypoints.Length * DescriptorBytes)
      throw new ArgumentException(Keypoints.Length + " keypoints need " + Keypoints.Length * (long)DescriptorBytes +
                                  " bytes of descriptors; there are " + Descriptors.Length);
    if (Cameras != null && Cameras.Length < Keypoints.Length)
      throw new ArgumentException(Keypoints.Length + " keypoints need as many cameras; there are " + Cameras.Length);
  }
}

internal sealed unsafe class FeaturesHandle : NativeHandle {
  internal FeaturesHandle(LocalizerConfig config) : base("Features") {
    long* room = stackalloc long[LocalizerConfig.CameraLongs];
    Native.sphc_localizer_config raw = config.Borrow(room);
    Native.sphc_memory need;
    Native.sphc_features* features = null;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_features_memory(&raw, &need, &message), ref message);
    AlignedMemory state = Allocate(need.state_bytes, need.alignment);
    Status status = Native.sphc_features_init(state.Start, Size.Of(state.Bytes), &raw, &features, &message);
    Adopt(features, status, ref message);
  }

  protected override void End(void* instance) {
    var features = (Native.sphc_features*)instance;
    Native.sphc_features_fini(&features);
  }
}
}
