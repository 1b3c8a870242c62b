package org.spherecloud;

import java.lang.ref.Reference;
import java.util.Objects;

/**
 * A rigid transform, named target_from_source everywhere: x_target = R(q) x_source + t.  Where it is a part of a result
 * or a config, it shows what that holds now; {@link #copy} gives one that stays.
 */
public final class Rigid extends RigidFields {
  /** The identity. */
  public Rigid() {
    setQuaternionWxyz(1, 0, 0, 0);
  }

  /** From a unit quaternion, real part first, and metres. */
  public Rigid(double qW, double qX, double qY, double qZ, double xM, double yM, double zM) {
    set(qW, qX, qY, qZ, xM, yM, zM);
  }

  Rigid(Struct whole, int at) {
    super(whole, at);
  }

  /** Sets all of it. */
  public void set(double qW, double qX, double qY, double qZ, double xM, double yM, double zM) {
    putDouble(Layout.RIGID_Q_WXYZ, qW);
    putDouble(Layout.RIGID_Q_WXYZ + 8, qX);
    putDouble(Layout.RIGID_Q_WXYZ + 16, qY);
    putDouble(Layout.RIGID_Q_WXYZ + 24, qZ);
    putDouble(Layout.RIGID_T_M, xM);
    putDouble(Layout.RIGID_T_M + 8, yM);
    putDouble(Layout.RIGID_T_M + 16, zM);
  }

  /** Takes over another one. */
  public void set(Rigid other) {
    copy(other, Layout.RIGID_BYTES);
  }

  /** One of its own that does not change with this one. */
  public Rigid copy() {
    Rigid made = new Rigid();
    made.set(this);
    return made;
  }

  /** c_from_a = c_from_b * b_from_a, where this is c_from_b; a new one, with its quaternion normalised. */
  public Rigid compose(Rigid bFromA) {
    Objects.requireNonNull(bFromA, "bFromA");
    Rigid cFromA = new Rigid();
    Native.rigidCompose(address, bFromA.address, cFromA.address);
    Reference.reachabilityFence(bFromA);
    Reference.reachabilityFence(this);
    return cFromA;
  }

  /** a_from_b, where this is b_from_a; a new one. */
  public Rigid inverse() {
    Rigid made = new Rigid();
    Native.rigidInverse(address, made.address);
    Reference.reachabilityFence(this);
    return made;
  }

  /** x_target of a point x_source: three numbers in metres, in a new array. */
  public double[] apply(double... source) {
    Scratch scratch = Scratch.mine();
    scratch.put(0, Scratch.sized(source, 3, "source"));
    Native.rigidApply(address, scratch.address(0), scratch.address(0));
    Reference.reachabilityFence(this);
    double[] target = new double[3];
    scratch.get(0, target);
    return target;
  }

  /** The seven numbers, as qw qx qy qz x y z. */
  @Override
  public String toString() {
    double[] q = getQuaternionWxyz();
    double[] t = getTranslationM();
    return "q_wxyz " + q[0] + " " + q[1] + " " + q[2] + " " + q[3] + ", t_m " + t[0] + " " + t[1] + " " + t[2];
  }
}
