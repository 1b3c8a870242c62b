using System;
using System.IO;
using SphereCloud;

/// <summary>Mistakes are exceptions with words that help, and never crashes.</summary>
internal static class MisuseTest {
  internal static LocalizerResult result;  // that nobody looks at

  public static void ClosedObjectsSaySo() {
    Localizer localizer = Session.Localizer();
    Map map = Map.Open(Session.MapPath);
    var features = new Features(Session.Config());
    localizer.Dispose();
    localizer.Dispose();
    map.Dispose();
    features.Dispose();
    Expect.Throws<ObjectDisposedException>(() => localizer.Process(Session.Frame(0), out result), "Localizer");
    Expect.Throws<ObjectDisposedException>(() => localizer.Reset(), "Localizer");
    Expect.Throws<ObjectDisposedException>(() => { int count = localizer.MapCount; }, "Localizer");
    Expect.Throws<ObjectDisposedException>(() => { MapInfo info = map.Info; }, "Map");
    Expect.Throws<ObjectDisposedException>(() => features.Read(), "Features");
    using (Localizer open = Session.Localizer()) {
      Expect.Throws<ObjectDisposedException>(() => open.SetMap(1, map), "Map");
      Expect.Throws<ObjectDisposedException>(() => open.Extract(Session.Frame(0), features), "Features");
      Expect.True(open.Process(Session.Frame(0), out result), "goes on");
    }
  }

  public static void NullIsNamed() {
    using (Localizer localizer = Session.Localizer()) {
      Expect.Throws<ArgumentNullException>(() => localizer.Process(null, out result), "frame");
      Expect.Throws<ArgumentNullException>(() => localizer.SetMap(0, null), "map");
      Expect.Throws<ArgumentNullException>(() => localizer.Observations(null), "into");
      Expect.Throws<ArgumentNullException>(() => new ImageData((byte[])null, 1, 1, PixelFormat.Gray8), "pixels");
      Expect.Throws<ArgumentNullException>(() => Map.FromBytes(null), "bytes");
      Expect.Throws<ArgumentNullException>(() => new Localizer(null), "config");
      Expect.True(localizer.Process(Session.Frame(0), out result), "goes on");
    }
  }

  public static void ImagesThatDoNotFitAreRefused() {
    using (Localizer localizer = Session.Localizer()) {
      Refused(localizer, frame => frame.Color = new ImageData(new byte[100 * 100], 100, 100, PixelFormat.Gray8));
      Refused(localizer, frame => frame.Color = default(ImageData));
      Refused(localizer, frame => frame.Color = new ImageData(IntPtr.Zero, 320, 240, PixelFormat.Gray8));
      Refused(localizer, frame => frame.Depth = new ImageData(new float[200 * 160], 200, 160));
      Expect.True(localizer.Process(Session.Frame(0), out result), "goes on");
    }
  }

  private static void Refused(Localizer localizer, Action<LocalizerFrame> spoil) {
    LocalizerFrame frame = Session.Frame(0);
    spoil(frame);
    var refused = Expect.Throws<SpherecloudException>(() => localizer.Process(frame, out result), "");
    Expect.Equal(Status.Image, refused.Status, "status of: " + refused.Message);
    Expect.True(refused.Explanation.Length > 10, "no explanation");
  }

  public static void ArraysThatAreTooSmallAreRefused() {
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[320 * 240 - 1], 320, 240, PixelFormat.Gray8), "76800");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[320 * 240], 320, 240, PixelFormat.Gray8, 0, 1), "76801");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[320 * 240], 320, 240, PixelFormat.Gray8, 0, -1), "");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[320 * 240], 320, 240, PixelFormat.Rgb8), "230400");
    Expect.Throws<ArgumentException>(() => new ImageData(new byte[10], -1, 240, PixelFormat.Gray8), "1 or more");
    Expect.Throws<ArgumentException>(() => new ImageData(new ushort[99], 10, 10), "200");
    var padded = new ImageData(new byte[9 * 16 + 10], 10, 10, PixelFormat.Gray8, 16);
    Expect.True(padded.IsSet, "the last row needs no padding");
  }

  public static void DamagedMapsAreRefused() {
    byte[] file = Session.Bytes("room.sphc");
    byte[] shorter = new byte[file.Length / 2], flipped = (byte[])file.Clone();
    Array.Copy(file, shorter, shorter.Length);
    flipped[file.Length - 100] ^= 1;
    Expect.Equal(Status.MapFormat, Expect.Throws<SpherecloudException>(() => Map.FromBytes(shorter), "").Status, "status");
    Expect.Equal(Status.MapChecksum, Expect.Throws<SpherecloudException>(() => Map.FromBytes(flipped), "").Status, "status");
    Expect.Throws<SpherecloudException>(() => Map.FromBytes(new byte[0]), "");
    Expect.Throws<FileNotFoundException>(() => Map.Open(Session.MapPath + ".no"), "");
  }

  public static void MoreMapsThanRoomAreRefused() {
    LocalizerConfig config = Session.Config();
    config.MaxMaps = 1;
    using (Localizer localizer = Session.Localizer(config))
    using (Map map = Map.Open(Session.MapPath)) {
      Expect.Equal(Status.Capacity, Expect.Throws<SpherecloudException>(() => localizer.SetMap(8, map), "max_maps").Status, "status");
      Expect.Equal(1, localizer.MapCount, "maps");
    }
  }

  public static void ConfigsThatCannotBeAreRefused() {
    LocalizerConfig config = Session.Config();
    config.MaxKeypoints = 0;
    Expect.Throws<SpherecloudException>(() => new Localizer(config), "max_keypoints");
    Expect.Throws<SpherecloudException>(() => new Features(config), "max_keypoints");
    Expect.Throws<SpherecloudException>(() => config.MemoryPieces(), "max_keypoints");
    config = Session.Config();
    config.ParallelTasks = 0;
    Expect.Throws<SpherecloudException>(() => new Localizer(config), "parallel_tasks");
    config.ParallelTasks = 9;
    Expect.Throws<SpherecloudException>(() => new Localizer(config), "parallel_tasks");
  }

  public static void NullInAListIsNamed() {
    LocalizerConfig cameras = Session.Config(), depthCameras = Session.Config();
    cameras.Cameras.Add(new LocalizerCamera { Camera = cameras.Rig.ColorCamera });
    cameras.Cameras.Add(null);
    depthCameras.DepthCameras.Add(null);
    foreach (Action<LocalizerConfig> use in new Action<LocalizerConfig>[] {
                 config => new Localizer(config), config => new Features(config), config => config.MemoryPieces()}) {
      Expect.Throws<ArgumentException>(() => use(cameras), "config.Cameras[1] is null; put a LocalizerCamera there");
      Expect.Throws<ArgumentException>(() => use(depthCameras), "config.DepthCameras[0] is null; put a LocalizerDepthCamera there");
    }
    LocalizerFrame views = Session.Frame(0), depthViews = Session.Frame(0);
    views.Views.Add(null);
    depthViews.DepthViews.Add(null);
    using (Localizer localizer = Session.Localizer()) {
      Expect.Throws<ArgumentException>(() => localizer.Process(views, out result), "frame.Views[0] is null; put a LocalizerView there");
      Expect.Throws<ArgumentException>(
          () => localizer.Process(depthViews, out result), "frame.DepthViews[0] is null; put a LocalizerDepthView there");
      Expect.True(localizer.Process(Session.Frame(0), out result), "goes on");
    }
  }

  public static void ALogThatCallsItsLocalizerIsStopped() {
    Localizer localizer = null;
    LocalizerConfig config = Session.Config();
    config.LogLevel = LogLevel.Debug;
    config.Log = (level, text) => { if (localizer != null) localizer.Reset(); };
    using (localizer = Session.Localizer(config))
      Expect.Throws<InvalidOperationException>(() => localizer.Process(Session.Frame(0), out result), "callback");
  }
}
