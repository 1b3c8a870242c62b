// As much of UnityEngine as the binding and its sample use, so that both are known to compile.
namespace UnityEngine {
public struct Vector3 {
  public float x, y, z;
  public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
}

public struct Quaternion {
  public float x, y, z, w;
  public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
}

public struct Pose {
  public Vector3 position;
  public Quaternion rotation;
  public Pose(Vector3 position, Quaternion rotation) { this.position = position; this.rotation = rotation; }
}

public class UnityException : System.Exception {
  public UnityException(string message) : base(message) {}
}

/// <summary>Of the thread that made it, as those of Unity are of the main thread.</summary>
public class Transform {
  private readonly System.Threading.Thread main = System.Threading.Thread.CurrentThread;
  public Vector3 position;
  public Quaternion rotation;

  public void SetPositionAndRotation(Vector3 position, Quaternion rotation) {
    if (System.Threading.Thread.CurrentThread != main) throw new UnityException("can only be called from the main thread");
    this.position = position;
    this.rotation = rotation;
  }
}

public class MonoBehaviour {
  public Transform transform = new Transform();
}

public class TextAsset {
  public byte[] bytes;
}

[System.AttributeUsage(System.AttributeTargets.Field)]
public sealed class SerializeFieldAttribute : System.Attribute {}

public static class Debug {
  public static void LogWarning(object message) {}
}
}
