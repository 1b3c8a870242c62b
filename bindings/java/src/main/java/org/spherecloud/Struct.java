package org.spherecloud;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.Objects;

/** A struct of the C interface in a direct buffer, or a part of one.  It belongs to one thread at a time. */
class Struct {
  /** Keeps the memory; of the whole struct, also where this is a part. */
  private final ByteBuffer bytes;
  private final int first;
  final long address;

  Struct(int size) {
    Library.require();
    bytes = ByteBuffer.allocateDirect(size).order(ByteOrder.nativeOrder());
    first = 0;
    address = Memory.address(bytes);
  }

  Struct(Struct whole, int at) {
    bytes = whole.bytes;
    first = whole.first + at;
    address = whole.address + at;
  }

  final int getInt(int at) {
    return bytes.getInt(first + at);
  }

  final void putInt(int at, int value) {
    bytes.putInt(first + at, value);
  }

  final long getLong(int at) {
    return bytes.getLong(first + at);
  }

  final void putLong(int at, long value) {
    bytes.putLong(first + at, value);
  }

  final float getFloat(int at) {
    return bytes.getFloat(first + at);
  }

  final void putFloat(int at, float value) {
    bytes.putFloat(first + at, value);
  }

  final double getDouble(int at) {
    return bytes.getDouble(first + at);
  }

  final void putDouble(int at, double value) {
    bytes.putDouble(first + at, value);
  }

  final double getDouble(int at, int index, int length) {
    if (index < 0 || index >= length) throw new IndexOutOfBoundsException(index + " is not from 0 to " + (length - 1));
    return bytes.getDouble(first + at + 8 * index);
  }

  final double[] getDoubles(int at, int length) {
    double[] values = new double[length];
    for (int i = 0; i < length; i++) values[i] = bytes.getDouble(first + at + 8 * i);
    return values;
  }

  final void putDoubles(int at, int length, double[] values) {
    Objects.requireNonNull(values, "values");
    if (values.length != length) throw new IllegalArgumentException(values.length + " numbers; " + length + " are needed");
    for (int i = 0; i < length; i++) bytes.putDouble(first + at + 8 * i, values[i]);
  }

  final byte[] getBytes(int at, int length) {
    byte[] values = new byte[length];
    for (int i = 0; i < length; i++) values[i] = bytes.get(first + at + i);
    return values;
  }

  final long getPointer(int at) {
    return Memory.POINTER_BYTES == 8 ? getLong(at) : getInt(at) & 0xFFFFFFFFL;
  }

  final void putPointer(int at, long value) {
    if (Memory.POINTER_BYTES == 8) putLong(at, value);
    else putInt(at, (int) value);
  }

  /** A null struct is a null pointer. */
  final void putPointer(int at, Struct struct) {
    putPointer(at, struct == null ? 0 : struct.address);
  }

  final void copy(Struct other, int size) {
    Memory.copy(address, Objects.requireNonNull(other, "other").address, size);
    java.lang.ref.Reference.reachabilityFence(other);
  }
}
