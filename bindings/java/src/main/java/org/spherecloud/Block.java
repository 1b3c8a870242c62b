package org.spherecloud;

import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.LongConsumer;

/** Memory for one of the library's objects.  The last of its holders frees it. */
final class Block implements Holding {
  private static final AtomicInteger COUNT = new AtomicInteger();
  final long address;
  private final long bytes;
  private final AtomicInteger holders = new AtomicInteger(1);
  private long object;
  private LongConsumer fini;

  Block(long bytes, long alignment) {
    this.bytes = bytes;
    address = NativeBytes.allocate(bytes, alignment);
    if (address == 0) throw new OutOfMemoryError("no " + bytes + " bytes of native memory; lower the config's capacities");
    COUNT.incrementAndGet();
  }

  /** How many are not freed. */
  static int count() {
    return COUNT.get();
  }

  /** The object that lies here, and what ends it before the memory goes. */
  void holds(long object, LongConsumer fini) {
    this.object = object;
    this.fini = fini;
  }

  Block retain() {
    holders.incrementAndGet();
    return this;
  }

  @Override
  public void release() {
    if (holders.decrementAndGet() != 0) return;
    if (fini != null) {
      Scratch scratch = Scratch.mine();
      scratch.putPointer(object);
      fini.accept(scratch.address(0));
    }
    NativeBytes.free(address, bytes);
    COUNT.decrementAndGet();
  }
}
