using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Answers where the colour camera is in its maps. One call at a time for each localizer, except Extract, which
/// may run beside all others but Process and Extract; a second call at the same time throws InvalidOperationException.
/// Process, Extract, Locate and Predict allocate nothing.</summary>
public sealed unsafe class Localizer : IDisposable {
  internal readonly LocalizerHandle Handle;

  /// <summary>Has no map yet. Takes its memory here, once; config is copied. Throws SpherecloudException where the config
  /// cannot be used. Any thread.</summary>
  public Localizer(LocalizerConfig config) {
    if (config == null) throw new ArgumentNullException(nameof(config));
    Handle = new LocalizerHandle(config);
  }

  // ---- maps

  /// <summary>How many maps it has.</summary>
  public int MapCount {
    get {
      using (var use = Handle.Enter(Lane.Main)) return (int)Native.sphc_localizer_map_count(At(use));
    }
  }

  /// <summary>Gives it a map, or a newer release of the map with this number, between any two frames. The map stays alive
  /// until it is replaced or removed, or the localizer ends. Throws SpherecloudException: config.MaxMaps are there, or
  /// the map is of another band.</summary>
  public void SetMap(uint mapId, Map map) {
    if (map == null) throw new ArgumentNullException(nameof(map));
    using (var use = Handle.Enter(Lane.Main)) {
      map.Handle.Keep();
      Status status = Native.sphc_localizer_set_map(At(use), mapId, map.Handle.Pointer);
      if (status < 0) map.Handle.DangerousRelease();
      Check(use, status);
      Handle.Replace(mapId, map.Handle);
    }
  }

  /// <summary>Takes a map away. Throws SpherecloudException where there is none of this number.</summary>
  public void RemoveMap(uint mapId) {
    using (var use = Handle.Enter(Lane.Main)) {
      Check(use, Native.sphc_localizer_remove_map(At(use), mapId));
      Handle.Replace(mapId, null);
    }
  }

  /// <summary>Says where a map lies in a frame that several maps share, such as a building's, with its errors, 1 sigma an
  /// axis. Poses stay in the frames of their maps. Null: it is not known. Throws SpherecloudException: no such map, or
  /// beyond a limit.</summary>
  public void SetMapTransform(uint mapId, Rigid? commonFromMap, double rotationSigmaRad = 0, double translationSigmaM = 0) {
    Rigid transform = commonFromMap.GetValueOrDefault();
    using (var use = Handle.Enter(Lane.Main))
      Check(use, Native.sphc_localizer_set_map_transform(At(use), mapId, commonFromMap != null ? &transform : null,
                                                         rotationSigmaRad, translationSigmaM));
  }

  // ---- frames

  /// <summary>Where was the colour camera? True: result.CameraFromMap is the pose. False: result.Outcome says why there
  /// is none, and result.Hints what may help. In LocalizerMode.Tracking frames come in the order of their ColorTimeNs.
  /// Throws SpherecloudException where the frame does not fit the config; the next one may.</summary>
  public bool Process(LocalizerFrame frame, out LocalizerResult result) {
    LocalizerResult found = EmptyResult();
    long* room = stackalloc long[LentFrame.Longs];
    bool localized;
    using (var use = Handle.Enter(Lane.Main | Lane.Extract))
    using (var lent = new LentFrame(frame, room))
      localized = Check(use, Native.sphc_localizer_process(At(use), lent.Raw, &found));
    result = found;
    return localized;
  }

  /// <summary>The first half of Process: finds the features of the frame's colour image and views, which may go
  /// afterwards. frame.DeadlineUs bounds this half alone. Throws SpherecloudException where frame or features do not fit
  /// the config; the features stay what they were. May run beside other calls but Process and Extract.</summary>
  public void Extract(LocalizerFrame frame, Features features) {
    if (features == null) throw new ArgumentNullException(nameof(features));
    long* room = stackalloc long[LentFrame.Longs];
    using (var use = Handle.Enter(Lane.Extract))
    using (var fill = features.Handle.Enter(Lane.Main))
    using (var lent = new LentFrame(frame, room)) {
      var into = (Native.sphc_features*)fill.Instance;
      Status status = Native.sphc_localizer_extract(At(use), lent.Raw, into);
      Callbacks.Rethrow();
      Features.Check(into, status);
    }
  }

  /// <summary>The second half of Process, with the same result. The images of frame.Color and of its views are not looked
  /// at. Throws SpherecloudException: also where the features are of another frame, or of none.</summary>
  public bool Locate(LocalizerFrame frame, Features features, out LocalizerResult result) {
    if (features == null) throw new ArgumentNullException(nameof(features));
    LocalizerResult found = EmptyResult();
    long* room = stackalloc long[LentFrame.Longs];
    bool localized;
    using (var use = Handle.Enter(Lane.Main))
    using (var read = features.Handle.Read())
    using (var lent = new LentFrame(frame, room))
      localized = Check(use, Native.sphc_localizer_locate(At(use), lent.Raw, (Native.sphc_features*)read.Instance, &found));
    result = found;
    return localized;
  }

  /// <summary>Where is the colour camera at a time of the program's, such as when a display lights up? In nanoseconds, in
  /// the time of frames. True: prediction.CameraFromMap is the pose. False: none is known at that time. Changes
  /// nothing.</summary>
  public bool Predict(long timeNs, out LocalizerPrediction prediction) {
    var found = new LocalizerPrediction { struct_size = (uint)sizeof(LocalizerPrediction) };
    bool known;
    using (var use = Handle.Enter(Lane.Main)) known = Check(Native.sphc_localizer_predict(At(use), timeNs, &found));
    prediction = found;
    return known;
  }

  /// <summary>Forgets where the camera was, as after a long pause. What was learnt of the depth sensor stays.</summary>
  public void Reset() {
    using (var use = Handle.Enter(Lane.Main)) Native.sphc_localizer_reset(At(use));
  }

  // ---- what became of the last frame

  /// <summary>Copies what became of the keypoints of the last processed frame, as many as there is room for. Returns how
  /// many there are.</summary>
  public int Observations(LocalizerObservation[] into) {
    if (into == null) throw new ArgumentNullException(nameof(into));
    uint count;
    using (var use = Handle.Enter(Lane.Main))
    fixed (LocalizerObservation* first = into)
      Check(Native.sphc_localizer_observations(At(use), first, (uint)sizeof(LocalizerObservation), (uint)into.Length, &count));
    return (int)count;
  }

  /// <summary>The same, in an array of that size.</summary>
  public LocalizerObservation[] Observations() {
    var found = new LocalizerObservation[Observations(new LocalizerObservation[0])];
    Observations(found);
    return found;
  }

  /// <summary>Copies the poses that the last processed frame may have, those of most gain first, as many as there is room
  /// for. Returns how many there are, at most Limits.HypothesesMax.</summary>
  public int Hypotheses(LocalizerHypothesis[] into) {
    if (into == null) throw new ArgumentNullException(nameof(into));
    uint count;
    using (var use = Handle.Enter(Lane.Main))
    fixed (LocalizerHypothesis* first = into)
      Check(Native.sphc_localizer_hypotheses(At(use), first, (uint)sizeof(LocalizerHypothesis), (uint)into.Length, &count));
    return (int)count;
  }

  /// <summary>The same, in an array of that size.</summary>
  public LocalizerHypothesis[] Hypotheses() {
    var found = new LocalizerHypothesis[Hypotheses(new LocalizerHypothesis[0])];
    Hypotheses(found);
    return found;
  }

  // ---- for those who measure

  /// <summary>What a parameter of the search may be. Throws SpherecloudException for one that the library does not
  /// know. Any thread.</summary>
  public static LocalizerParameterRange ParameterRange(LocalizerParameter parameter) {
    Library.Require();
    var range = new LocalizerParameterRange { struct_size = (uint)sizeof(LocalizerParameterRange) };
    CheckKnown(parameter, Native.sphc_localizer_get_parameter_range(parameter, &range));
    return range;
  }

  /// <summary>Changes the search from the next frame on. Throws SpherecloudException: out of range, or not
  /// known.</summary>
  public void SetParameter(LocalizerParameter parameter, double value) {
    using (var use = Handle.Enter(Lane.Main)) Check(use, Native.sphc_localizer_set_parameter(At(use), parameter, value));
  }

  /// <summary>How the search goes. Throws SpherecloudException for a parameter that the library does not know.</summary>
  public double GetParameter(LocalizerParameter parameter) {
    double value;
    using (var use = Handle.Enter(Lane.Main))
      CheckKnown(parameter, Native.sphc_localizer_get_parameter(At(use), parameter, &value));
    return value;
  }

  /// <summary>Says what is known of the depth sensor from before, such as result.Depth of an earlier run. Throws
  /// SpherecloudException where it cannot be one of this config.</summary>
  public void SetDepthBias(DepthBias depth) {
    using (var use = Handle.Enter(Lane.Main)) Check(use, Native.sphc_localizer_set_depth_bias(At(use), &depth));
  }

  /// <summary>Frees the memory and lets the maps go, once calls that are under way have ended.</summary>
  public void Dispose() {
    Handle.Dispose();
  }

  /// <summary>The library writes into this one, on the stack: no other thread can reach its size meanwhile.</summary>
  private static LocalizerResult EmptyResult() {
    return new LocalizerResult { struct_size = (uint)sizeof(LocalizerResult) };
  }

  private static Native.sphc_localizer* At(NativeHandle.Use use) {
    return (Native.sphc_localizer*)use.Instance;
  }

  /// <summary>Of calls that leave no message and fail for a parameter that is not known.</summary>
  private static void CheckKnown(LocalizerParameter parameter, Status status) {
    if (status == Status.Unsupported) throw new SpherecloudException(
        status, "the library " + Library.Version + " knows no parameter " + parameter +
                "; give one of LocalizerParameter, or use a library that has it");
    SpherecloudException.Check(status);
  }

  /// <summary>Of calls that change nothing, and so leave no message. True where the answer is a yes.</summary>
  private static bool Check(Status status) {
    SpherecloudException.Check(status);
    return status == Status.Ok;
  }

  /// <summary>Of all others.</summary>
  private static bool Check(NativeHandle.Use use, Status status) {
    Callbacks.Rethrow();
    if (status < 0) throw new SpherecloudException(status, Text.Of(Native.sphc_localizer_message(At(use))));
    return status == Status.Ok;
  }
}

/// <remarks>default(LocalizerResult) is of no frame: IsSet is false, all confidence is 0, and Outcome reads as Localized, as
/// that is 0.</remarks>
public unsafe partial struct LocalizerResult {
  /// <summary>True where a frame has filled it, with a pose or without.</summary>
  public bool IsSet { get { return struct_size != 0; } }

  /// <summary>The probability that the camera is within so many metres and radians of the pose; 0 where there is no pose,
  /// or no frame. docs/confidence.md says how far it can be trusted. Any thread.</summary>
  public double ConfidenceWithin(double translationM, double rotationRad) {
    Library.Require();
    if (!IsSet) return 0;
    LocalizerResult result = this;
    result.struct_size = (uint)sizeof(LocalizerResult);
    return Native.sphc_localizer_result_confidence(&result, translationM, rotationRad);
  }
}

/// <summary>Keeps its maps alive, and what calls back need.</summary>
internal sealed unsafe class LocalizerHandle : NativeHandle {
  private readonly Dictionary<uint, MapHandle> maps = new Dictionary<uint, MapHandle>();
  private Callbacks called;
  private GCHandle callbacks;  // of the same

  internal LocalizerHandle(LocalizerConfig config) : base("Localizer") {
    long* room = stackalloc long[LocalizerConfig.CameraLongs];
    Native.sphc_localizer_config raw = config.Borrow(room);
    Native.sphc_memory need;
    Native.sphc_localizer* localizer = null;
    var message = new Native.sphc_message();
    SpherecloudException.Check(Native.sphc_localizer_memory(&raw, &need, &message), ref message);
    called = new Callbacks(config);  // before there is memory, which would be lost where threads cannot be started
    callbacks = GCHandle.Alloc(called);
    called.Fill(&raw, callbacks);
    AlignedMemory state = Allocate(need.state_bytes, need.alignment), scratch = Allocate(need.scratch_bytes, need.alignment);
    Status status = Native.sphc_localizer_init(state.Start, Size.Of(state.Bytes), scratch.Start, Size.Of(scratch.Bytes),
                                               &raw, &localizer, &message);
    Adopt(localizer, status, ref message);
    Callbacks.Rethrow();
  }

  /// <summary>Notes the map that has this number now, which is kept already, and lets the one before go.</summary>
  internal void Replace(uint mapId, MapHandle map) {
    MapHandle before;
    maps.TryGetValue(mapId, out before);
    if (map != null) maps[mapId] = map;
    else maps.Remove(mapId);
    if (before != null) before.DangerousRelease();
  }

  protected override void End(void* instance) {
    var localizer = (Native.sphc_localizer*)instance;
    Native.sphc_localizer_fini(&localizer);
    foreach (MapHandle map in maps.Values) map.DangerousRelease();
    maps.Clear();
    if (called != null) called.Stop();
    if (callbacks.IsAllocated) callbacks.Free();
  }
}
}
