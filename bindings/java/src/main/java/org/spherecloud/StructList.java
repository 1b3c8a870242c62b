package org.spherecloud;

import java.util.AbstractList;
import java.util.RandomAccess;

/**
 * Structs one behind the other in one buffer, made once and filled again and again.  As a list it has those that the
 * last call filled; its elements show what the buffer holds now.
 */
class StructList<E extends Struct> extends Struct {
  /** Makes the element that lies so far in. */
  interface Maker<E> {
    E make(Struct whole, int at);
  }

  private final Struct[] elements;
  private int count;
  private final AbstractList<E> list = new Filled();

  StructList(int capacity, int elementBytes, Maker<E> maker) {
    super(Math.max(bytes(capacity, elementBytes), elementBytes));
    elements = new Struct[capacity];
    for (int i = 0; i < capacity; i++) elements[i] = maker.make(this, i * elementBytes);
  }

  /** Of so many elements, one behind the other in a buffer. */
  static int bytes(int capacity, int elementBytes) {
    long bytes = (long) capacity * elementBytes;
    if (capacity >= 0 && bytes <= Integer.MAX_VALUE) return (int) bytes;
    throw new IllegalArgumentException("There is no room for " + capacity + " elements of " + elementBytes
        + " bytes; give a number that is not negative, and for less than 2 GiB");
  }

  /** Filled or not. */
  @SuppressWarnings("unchecked")
  final E at(int index) {
    return (E) elements[index];
  }

  final int capacity() {
    return elements.length;
  }

  /** Those that are filled.  The list object is always the same one. */
  public java.util.List<E> getFilled() {
    return list;
  }

  final void fill(int found) {
    count = Math.min(found, elements.length);
  }

  private final class Filled extends AbstractList<E> implements RandomAccess {
    @Override
    public E get(int index) {
      java.util.Objects.checkIndex(index, count);
      return at(index);
    }

    @Override
    public int size() {
      return count;
    }
  }
}
