using System.Globalization;
using System.Runtime.InteropServices;

namespace SphereCloud {
/// <summary>Two numbers, such as a pixel.</summary>
[StructLayout(LayoutKind.Sequential)]
public struct Vector2d {
  /// <summary>To the right.</summary>
  public double X;
  /// <summary>Downwards.</summary>
  public double Y;

  /// <summary>Of its parts.</summary>
  public Vector2d(double x, double y) {
    X = x;
    Y = y;
  }

  /// <summary>"(x, y)".</summary>
  public override string ToString() {
    return string.Format(CultureInfo.InvariantCulture, "({0}, {1})", X, Y);
  }
}

/// <summary>Three numbers: a point, a direction or a velocity.</summary>
[StructLayout(LayoutKind.Sequential)]
public struct Vector3d {
  /// <summary>First part.</summary>
  public double X;
  /// <summary>Second part.</summary>
  public double Y;
  /// <summary>Third part.</summary>
  public double Z;

  /// <summary>Of its parts.</summary>
  public Vector3d(double x, double y, double z) {
    X = x;
    Y = y;
    Z = z;
  }

  /// <summary>"(x, y, z)".</summary>
  public override string ToString() {
    return string.Format(CultureInfo.InvariantCulture, "({0}, {1}, {2})", X, Y, Z);
  }
}

/// <summary>A rotation, as a quaternion of length 1. The real part is first, as in the C interface.</summary>
[StructLayout(LayoutKind.Sequential)]
public struct Quaterniond {
  /// <summary>The real part.</summary>
  public double W;
  /// <summary>Part along x.</summary>
  public double X;
  /// <summary>Part along y.</summary>
  public double Y;
  /// <summary>Part along z.</summary>
  public double Z;

  /// <summary>Of its parts, the real one first.</summary>
  public Quaterniond(double w, double x, double y, double z) {
    W = w;
    X = x;
    Y = y;
    Z = z;
  }

  /// <summary>No rotation.</summary>
  public static Quaterniond Identity { get { return new Quaterniond(1, 0, 0, 0); } }

  /// <summary>"(w, x, y, z)".</summary>
  public override string ToString() {
    return string.Format(CultureInfo.InvariantCulture, "({0}, {1}, {2}, {3})", W, X, Y, Z);
  }
}

/// <summary>A rigid transform. Its name says target_from_source: x_target = R x_source + t.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct Rigid {
  /// <summary>R.</summary>
  public Quaterniond Rotation;
  /// <summary>t, in metres.</summary>
  public Vector3d TranslationM;

  /// <summary>Of its parts.</summary>
  public Rigid(Quaterniond rotation, Vector3d translationM) {
    Rotation = rotation;
    TranslationM = translationM;
  }

  /// <summary>The transform that changes nothing.</summary>
  public static Rigid Identity { get { return new Rigid(Quaterniond.Identity, new Vector3d()); } }

  /// <summary>c_from_a = c_from_b * b_from_a; the quaternion is normalised. Any thread.</summary>
  public static Rigid operator *(Rigid cFromB, Rigid bFromA) {
    Library.Require();
    Rigid cFromA;
    Native.sphc_rigid_compose(&cFromB, &bFromA, &cFromA);
    return cFromA;
  }

  /// <summary>a_from_b of this b_from_a. Any thread.</summary>
  public Rigid Inverse() {
    Library.Require();
    Rigid bFromA = this, aFromB;
    Native.sphc_rigid_inverse(&bFromA, &aFromB);
    return aFromB;
  }

  /// <summary>x_b of x_a, in metres, where this is b_from_a. Any thread.</summary>
  public Vector3d Apply(Vector3d pointM) {
    Library.Require();
    Rigid bFromA = this;
    Vector3d moved;
    Native.sphc_rigid_apply(&bFromA, (double*)&pointM, (double*)&moved);
    return moved;
  }

  /// <summary>Rotation and translation.</summary>
  public override string ToString() {
    return Rotation + " " + TranslationM + " m";
  }
}

/// <summary>The 6 x 6 covariance of a pose: rotation vector in radians, then translation in metres, in the camera's
/// frame.</summary>
[StructLayout(LayoutKind.Sequential)]
public unsafe struct PoseCovariance {
  internal fixed double values[36];

  /// <summary>Of row and column, each 0 to 5.</summary>
  public double this[int row, int column] {
    get {
      if (row < 0 || row > 5 || column < 0 || column > 5)
        throw new System.IndexOutOfRangeException("rows and columns are 0 to 5");
      fixed (double* first = values) return first[6 * row + column];
    }
  }
}
}
