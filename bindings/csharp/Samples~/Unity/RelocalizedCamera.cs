using SphereCloud;
using UnityEngine;

/// <summary>Puts its object where the colour camera is. Another component hands it the images of the headset.</summary>
public sealed class RelocalizedCamera : MonoBehaviour {
  [SerializeField] private TextAsset mapFile = null;  // a .sphc file with the ending .bytes

  private readonly object working = new object();  // held while a frame is looked at: guards these three
  private Localizer localizer;
  private LocalizerFrame frame;
  private Rigid worldFromMap;

  private readonly object handover = new object();  // held for a moment: guards these two
  private Pose newest;
  private bool isNew;

  /// <summary>On Unity's main thread; again for another rig. A call of OnImages that is under way ends first.</summary>
  public void Begin(Rig rig) {
    End();
    using (Map map = Map.FromBytes(mapFile.bytes))
      lock (working) {
        worldFromMap = Conventions.MakeWorld(Convention.Unity, new Vector3d(0, -1, 0));  // the map's y is down
        frame = new LocalizerFrame();
        localizer = new Localizer(new LocalizerConfig { Rig = rig });
        localizer.SetMap(0, map);
      }
  }

  /// <summary>Images of the rig's sizes: grey bytes, and depth in the rig's unit. Takes some milliseconds, on any thread: a
  /// program that draws meanwhile calls it from one of its own. Does nothing before Begin and after the object was
  /// destroyed.</summary>
  public void OnImages(long timeNs, byte[] gray, int width, int height, ushort[] depth, int depthWidth, int depthHeight) {
    lock (working) {
      if (localizer == null) return;
      frame.ColorTimeNs = frame.DepthTimeNs = timeNs;
      frame.Color = new ImageData(gray, width, height, PixelFormat.Gray8);
      frame.Depth = new ImageData(depth, depthWidth, depthHeight);
      if (localizer.Process(frame, out LocalizerResult result))
        HandOver(UnityPose.OfCamera(worldFromMap, result.CameraFromMap).ToPose());
    }
  }

  private void HandOver(Pose pose) {
    lock (handover) {
      newest = pose;
      isNew = true;
    }
  }

  /// <summary>Unity lets its main thread alone move a transform.</summary>
  private void Update() {
    lock (handover) {
      if (!isNew) return;
      isNew = false;
      transform.SetPositionAndRotation(newest.position, newest.rotation);
    }
  }

  private void OnDestroy() {
    End();
  }

  private void End() {
    lock (working) {
      if (localizer != null) localizer.Dispose();
      localizer = null;
    }
    lock (handover) isNew = false;  // of the former rig
  }
}
