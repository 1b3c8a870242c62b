using System;
using System.Reflection;
using System.Threading;
using SphereCloud;
using UnityEngine;

/// <summary>The component of Samples~/Unity, by stand-ins.</summary>
internal static class SampleTest {
  /// <summary>Unity makes components when a scene is loaded, also where the native library is missing.</summary>
  public static void ItsConstructorCallsNothingNative() {
    var made = new RelocalizedCamera();
    foreach (FieldInfo field in typeof(RelocalizedCamera).GetFields(BindingFlags.Instance | BindingFlags.NonPublic))
      if (field.FieldType.Namespace == "SphereCloud") Expect.Equal(Unset(field.FieldType), field.GetValue(made), field.Name);
    Show(made, 0);
    Send(made, "Update");
    Send(made, "OnDestroy");
  }

  private static object Unset(Type type) {
    return type.IsValueType ? Activator.CreateInstance(type) : null;
  }

  public static void ItMovesOnTheMainThreadAlone() {
    RelocalizedCamera camera = Begun();
    Exception failure = null;
    var thread = new Thread(() => {
      try {
        Show(camera, 0);
      } catch (Exception thrown) {
        failure = thrown;
      }
    });
    thread.Start();
    thread.Join();
    Expect.Equal(null, failure, "failure of the thread");
    Expect.Equal(0f, Length(camera.transform.position), "moved before Update");
    Send(camera, "Update");
    Expect.True(Length(camera.transform.position) > 0, "did not move");
    camera.transform.position = new Vector3();
    Send(camera, "Update");
    Expect.Equal(0f, Length(camera.transform.position), "moved by the same pose again");
    Send(camera, "OnDestroy");
  }

  public static void ASecondBeginEndsTheFirst() {
    RelocalizedCamera camera = Begun();
    Localizer first = LocalizerOf(camera);
    camera.Begin(Session.Rig());
    Localizer second = LocalizerOf(camera);
    Expect.Throws<ObjectDisposedException>(() => first.Reset(), "Localizer");
    second.Reset();
    Send(camera, "OnDestroy");
    Expect.Throws<ObjectDisposedException>(() => second.Reset(), "Localizer");
    Show(camera, 0);
  }

  private static RelocalizedCamera Begun() {
    var camera = new RelocalizedCamera();
    Field("mapFile").SetValue(camera, new TextAsset { bytes = Session.Bytes("room.sphc") });
    camera.Begin(Session.Rig());
    return camera;
  }

  private static void Show(RelocalizedCamera camera, int index) {
    Row row = Session.Frames[index];
    var depth = new ushort[200 * 160];
    Buffer.BlockCopy(Session.Bytes(row["depth_file"]), 0, depth, 0, 2 * depth.Length);
    camera.OnImages(row.Whole("color_time_ns"), Session.Bytes(row["color_file"]), 320, 240, depth, 200, 160);
  }

  private static Localizer LocalizerOf(RelocalizedCamera camera) {
    return (Localizer)Field("localizer").GetValue(camera);
  }

  private static FieldInfo Field(string name) {
    return typeof(RelocalizedCamera).GetField(name, BindingFlags.Instance | BindingFlags.NonPublic);
  }

  /// <summary>As Unity calls its messages, which are private.</summary>
  private static void Send(RelocalizedCamera camera, string message) {
    typeof(RelocalizedCamera).GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(camera, null);
  }

  private static float Length(Vector3 v) {
    return Math.Abs(v.x) + Math.Abs(v.y) + Math.Abs(v.z);
  }
}
