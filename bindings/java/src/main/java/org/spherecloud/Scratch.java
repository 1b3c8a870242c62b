package org.spherecloud;

/** A thread's room for a message, numbers and a pointer that go in or come out of one call. */
final class Scratch extends Struct {
  private static final int NUMBERS = Layout.MESSAGE_BYTES;
  private static final int CAPACITY = 16;
  private static final ThreadLocal<Scratch> MINE = ThreadLocal.withInitial(Scratch::new);

  Scratch() {
    super(NUMBERS + 8 * CAPACITY);
  }

  /** That of this thread, with no message. */
  static Scratch mine() {
    Scratch scratch = MINE.get();
    scratch.putInt(0, 0);
    return scratch;
  }

  long messageAddress() {
    return address;
  }

  String message() {
    byte[] text = getBytes(0, Layout.MESSAGE_BYTES);
    int length = 0;
    while (length < text.length && text[length] != 0) length++;
    return new String(text, 0, length, java.nio.charset.StandardCharsets.UTF_8);
  }

  /** Of the number at this index. */
  long address(int index) {
    return address + NUMBERS + 8 * index;
  }

  /** Writes numbers from this index on. */
  void put(int index, double[] numbers) {
    for (int i = 0; i < numbers.length; i++) putDouble(NUMBERS + 8 * (index + i), numbers[i]);
  }

  /** Reads numbers from this index on. */
  void get(int index, double[] numbers) {
    for (int i = 0; i < numbers.length; i++) numbers[i] = getDouble(NUMBERS + 8 * (index + i));
  }

  int count() {
    return getInt(NUMBERS);
  }

  long pointer() {
    return getPointer(NUMBERS);
  }

  void putPointer(long value) {
    putPointer(NUMBERS, value);
  }

  /** An array of this length, or an exception that says which is needed. */
  static double[] sized(double[] numbers, int length, String name) {
    if (java.util.Objects.requireNonNull(numbers, name).length == length) return numbers;
    throw new IllegalArgumentException(name + " has " + numbers.length + " numbers; " + length + " are needed");
  }
}
