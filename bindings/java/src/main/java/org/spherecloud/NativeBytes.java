package org.spherecloud;

/**
 * The bytes outside the heap that the library's objects have.  The garbage collector does not see them, so a program that
 * closes nothing would take more and more of them while its heap stays small.
 */
final class NativeBytes {
  private NativeBytes() {}

  /** By so much they grow before a collection is asked for. */
  static final long BOUND = 128L << 20;

  private static long taken;
  /** What was taken after the last collection that was asked for, or less where some came back since. */
  private static long floor;

  static synchronized long taken() {
    return taken;
  }

  /** Whether a collection should be asked for. */
  private static synchronized boolean take(long bytes) {
    taken += bytes;
    return taken - floor > BOUND;
  }

  private static synchronized void collected() {
    floor = taken;
  }

  private static synchronized void giveBack(long bytes) {
    taken -= bytes;
    floor = Math.min(floor, taken);
  }

  /** Zeros; 0 where there is no memory, also after a collection. */
  static long allocate(long bytes, long alignment) {
    if (take(bytes)) {
      Net.collect();
      collected();
    }
    long address = Memory.allocate(bytes, alignment);
    if (address == 0) {
      Net.collect();
      address = Memory.allocate(bytes, alignment);
    }
    if (address == 0) giveBack(bytes);
    return address;
  }

  static void free(long address, long bytes) {
    Memory.free(address);
    giveBack(bytes);
  }
}
