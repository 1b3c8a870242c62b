using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using SphereCloud;

/// <summary>A row of a table, by the names of its columns.</summary>
internal sealed class Row {
  private readonly Dictionary<string, string> values = new Dictionary<string, string>();

  internal static List<Row> Read(string path) {
    string[] lines = File.ReadAllLines(path), names = lines[0].Split(',');
    var rows = new List<Row>();
    for (int i = 1; i < lines.Length; ++i) {
      string[] words = lines[i].Split(',');
      Expect.Equal(names.Length, words.Length, "columns of " + path);
      var row = new Row();
      for (int j = 0; j < names.Length; ++j) row.values[names[j]] = words[j];
      rows.Add(row);
    }
    return rows;
  }

  internal string this[string name] { get { return values[name]; } }

  internal bool Has(string name) {
    return values.ContainsKey(name) && values[name].Length > 0;
  }

  internal double Number(string name) {
    return double.Parse(values[name], NumberStyles.Float, CultureInfo.InvariantCulture);
  }

  internal long Whole(string name) {
    return long.Parse(values[name], CultureInfo.InvariantCulture);
  }

  internal double[] Numbers(string prefix, params string[] names) {
    return Array.ConvertAll(names, name => Number(prefix + name));
  }
}

/// <summary>The golden session, as it lies in its folder.</summary>
internal static class Session {
  internal static readonly string Folder = Environment.GetEnvironmentVariable("SPHERECLOUD_GOLDEN");
  internal static readonly List<Row> Frames = Row.Read(Path.Combine(Folder, "session.csv"));
  private static readonly Dictionary<string, double> setup = ReadSetup();
  private static readonly List<Row> cameras = Row.Read(Path.Combine(Folder, "cameras.csv"));

  internal static uint MapId { get { return (uint)setup["map_id"]; } }
  internal static string MapPath { get { return Path.Combine(Folder, "room.sphc"); } }

  private static Dictionary<string, double> ReadSetup() {
    var read = new Dictionary<string, double>();
    foreach (Row row in Row.Read(Path.Combine(Folder, "config.csv"))) read[row["field"]] = row.Number("value");
    return read;
  }

  private static CameraIntrinsics CameraOf(Row row) {
    return new CameraIntrinsics((CameraModel)row.Whole("model"), (int)row.Whole("width"), (int)row.Whole("height"),
                                row.Numbers("", "fx", "fy", "cx", "cy"));
  }

  internal static Rig Rig() {
    var colorFromDepth = new Rigid(Quaterniond.Identity, new Vector3d(setup["color_from_depth_x_m"], 0, 0));
    return new Rig(CameraOf(cameras[0]), CameraOf(cameras[1]), colorFromDepth);
  }

  internal static LocalizerConfig Config() {
    return new LocalizerConfig {
      Rig = Rig(), MaxKeypoints = (uint)setup["max_keypoints"], DepthSigmaM = setup["depth_sigma_m"]};
  }

  /// <summary>With the session's map.</summary>
  internal static Localizer Localizer(LocalizerConfig config = null) {
    var localizer = new Localizer(config ?? Config());
    using (Map map = Map.Open(MapPath)) localizer.SetMap(MapId, map);
    return localizer;
  }

  internal static byte[] Bytes(string name) {
    return File.ReadAllBytes(Path.Combine(Folder, name));
  }

  internal static LocalizerFrame Frame(int index) {
    Row row = Frames[index];
    return new LocalizerFrame {
      Sequence = (uint)row.Whole("sequence"), ColorTimeNs = row.Whole("color_time_ns"), DepthTimeNs = row.Whole("depth_time_ns"),
      Color = new ImageData(Bytes(row["color_file"]), 320, 240, PixelFormat.Gray8),
      Depth = new ImageData(Bytes(row["depth_file"]), 200, 160, PixelFormat.Depth16),
      Prior = row.Whole("has_up") != 0 ? Up(row.Number("up_sigma_rad")) : null};
  }

  private static LocalizerPrior Up(double sigmaRad) {
    return new LocalizerPrior {
      Flags = PriorParts.Up, MapId = MapId, UpCamera = new Vector3d(0, -1, 0), UpMap = new Vector3d(0, -1, 0),
      UpSigmaRad = sigmaRad};
  }

  internal static double[] Numbers(Rigid pose) {
    return new[] {pose.Rotation.W, pose.Rotation.X, pose.Rotation.Y, pose.Rotation.Z,
                  pose.TranslationM.X, pose.TranslationM.Y, pose.TranslationM.Z};
  }
}
