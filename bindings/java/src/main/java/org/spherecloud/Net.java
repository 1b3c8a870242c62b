package org.spherecloud;

import java.lang.ref.PhantomReference;
import java.lang.ref.ReferenceQueue;
import java.util.ArrayList;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

/**
 * What an object holds outside the heap: given back when it is closed, or else some time after it was lost.  Those that
 * the garbage collector has found are given back when the next object is made, so there is no thread, and no class that
 * old releases of Android lack.  {@link NativeBytes} says when the collector is asked to look.
 */
final class Net extends PhantomReference<Object> {
  private static final ReferenceQueue<Object> LOST = new ReferenceQueue<>();
  private static final int WAIT_MS = 50; // for what a collection hands over
  private static final Set<Net> ALL = ConcurrentHashMap.newKeySet();
  private final ArrayList<Holding> holdings = new ArrayList<>();

  Net(Object owner) {
    super(owner, LOST);
    releaseLost();
    ALL.add(this);
  }

  static void releaseLost() {
    for (Net lost = (Net) LOST.poll(); lost != null; lost = (Net) LOST.poll()) lost.release();
  }

  /** Asks for a collection, and gives back what it finds: it hands that over little by little, after its end. */
  static void collect() {
    Runtime.getRuntime().gc(); // System.gc of Android may do nothing
    try {
      for (Net lost = (Net) LOST.remove(WAIT_MS); lost != null; lost = (Net) LOST.remove(WAIT_MS)) lost.release();
    } catch (InterruptedException stopped) {
      Thread.currentThread().interrupt();
    }
  }

  <T extends Holding> T hold(T holding) {
    holdings.add(holding);
    return holding;
  }

  void drop(Holding holding) {
    holdings.remove(holding);
    holding.release();
  }

  /** In the order in which they were taken: an object ends before that which it borrows. */
  void release() {
    if (!ALL.remove(this)) return;
    holdings.forEach(Holding::release);
    holdings.clear();
  }
}
