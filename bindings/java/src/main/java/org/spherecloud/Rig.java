package org.spherecloud;

import java.lang.ref.Reference;

/** The colour and the depth camera of a headset. */
public final class Rig extends RigFields {
  /** Identity and millimetres; the cameras are zero and must be set. */
  public Rig() {
    Native.rigInit(address);
  }

  Rig(Struct whole, int at) {
    super(whole, at);
  }

  /** Takes over another one. */
  public void set(Rig other) {
    copy(other, Layout.RIG_BYTES);
  }

  /**
   * Does nothing where the rig can be used; what takes a rig checks it by itself.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: it cannot; the message names field, cause and cure
   */
  public void check() {
    Scratch scratch = Scratch.mine();
    int status = Native.rigCheck(address, scratch.messageAddress());
    Reference.reachabilityFence(this);
    Failure.check(status, scratch);
  }
}
