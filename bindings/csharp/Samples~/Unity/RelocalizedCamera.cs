using System;
using SphereCloud;
using UnityEngine;

/// <summary>Puts its object where the colour camera is. Another component hands it the images of the headset.</summary>
public sealed class RelocalizedCamera : MonoBehaviour {
  [SerializeField] private TextAsset mapFile = null;  // a .sphc file with the ending .bytes

  private readonly Rigid worldFromMap = Conventions.MakeWorld(Convention.Unity, new Vector3d(0, -1, 0));  // the map's y is down
  private Localizer localizer;
  private LocalizerFrame frame;

  public void Begin(Rig rig) {
    localizer = new Localizer(new LocalizerConfig { Rig = rig });
    using (Map map = Map.FromBytes(mapFile.bytes)) localizer.SetMap(0, map);
    frame = new LocalizerFrame();
  }

  /// <summary>Images of the rig's sizes: grey bytes, and depth in the rig's unit. Takes some milliseconds: a program that
  /// draws meanwhile calls it from a thread of its own, and moves the transform from Unity's.</summary>
  public void OnImages(long timeNs, byte[] gray, int width, int height, ushort[] depth, int depthWidth, int depthHeight) {
    frame.ColorTimeNs = frame.DepthTimeNs = timeNs;
    frame.Color = new ImageData(gray, width, height, PixelFormat.Gray8);
    frame.Depth = new ImageData(depth, depthWidth, depthHeight);
    if (!localizer.Process(frame, out LocalizerResult result)) return;
    Pose pose = UnityPose.OfCamera(worldFromMap, result.CameraFromMap).ToPose();
    transform.SetPositionAndRotation(pose.position, pose.rotation);
  }

  private void OnDestroy() {
    if (localizer != null) localizer.Dispose();
  }
}
