package org.spherecloud;

import java.util.concurrent.atomic.AtomicInteger;

/** One call at a time on an object, or several that only read, and none after its end.  Never waits: it refuses. */
final class Guard {
  private static final int EXCLUSIVE = -1;
  private static final int CLOSED = Integer.MIN_VALUE;
  private final AtomicInteger users = new AtomicInteger();
  private final String name;

  /** The name is that of the class. */
  Guard(String name) {
    this.name = name;
  }

  void enter() {
    if (!users.compareAndSet(0, EXCLUSIVE)) throw refusal();
  }

  void leave() {
    users.set(0);
  }

  void enterShared() {
    int before;
    do {
      before = users.get();
      if (before < 0) throw refusal();
    } while (!users.compareAndSet(before, before + 1));
  }

  void leaveShared() {
    users.decrementAndGet();
  }

  /** Whether this call closed it; false where it was closed already. */
  boolean close() {
    if (users.compareAndSet(0, CLOSED)) return true;
    if (users.get() == CLOSED) return false;
    throw refusal();
  }

  /** Closes it for good; whoever entered it calls this in place of leave. */
  void end() {
    users.set(CLOSED);
  }

  boolean isClosed() {
    return users.get() == CLOSED;
  }

  private IllegalStateException refusal() {
    return new IllegalStateException(isClosed()
        ? "The " + name + " object is closed; make a new one"
        : "The " + name + " object is in use by another call; let that end first, or use one for each thread");
  }
}
