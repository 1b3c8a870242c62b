package org.spherecloud;

import java.nio.ByteBuffer;

/** Memory outside the heap.  Written by hand in support.c. */
final class Memory {
  private Memory() {}

  static final int POINTER_BYTES = Library.load() ? pointerBytes() : 0;

  private static native int pointerBytes();

  /** Zeros; 0 where there is no memory. */
  static native long allocate(long bytes, long alignment);

  static native void free(long address);

  /** Of byte 0 of a direct buffer, whatever its position; 0 for any other buffer. */
  static native long address(ByteBuffer buffer);

  /** A buffer over memory that must outlive it. */
  static native ByteBuffer view(long address, long bytes);

  static native void copy(long to, long from, long bytes);
}
