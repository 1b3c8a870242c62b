package org.spherecloud;

import java.io.IOException;
import java.lang.ref.Reference;
import java.nio.ByteBuffer;
import java.nio.channels.FileChannel;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Objects;

/**
 * A map of a room: what a map file holds, checked and ready.  Several localizers of several threads may have it at the
 * same time.  Its memory goes when it is closed and no localizer has it any more.
 */
public final class SphereMap implements AutoCloseable {
  private final Guard guard = new Guard("SphereMap");
  private final Net net = new Net(this);
  private final Block block;
  private final long pointer;

  /** Reads the bytes of a file into memory that is there for them. */
  private interface Source {
    void read(ByteBuffer into) throws IOException;
  }

  private SphereMap(long fileBytes, Source source) throws IOException {
    Struct need = new Struct(Layout.MEMORY_BYTES);
    Failure.check(Native.mapMemory(need.address), "The library does not tell what a map needs; please report");
    long view = need.getLong(Layout.MEMORY_STATE_BYTES);
    long fileAt = (view + 63) / 64 * 64;
    block = net.hold(new Block(fileAt + fileBytes, Math.max(64, need.getInt(Layout.MEMORY_ALIGNMENT))));
    try {
      source.read(Memory.view(block.address + fileAt, fileBytes));
      Scratch scratch = Scratch.mine();
      Failure.check(Native.mapInit(block.address, view, block.address + fileAt, fileBytes, scratch.address(0),
          scratch.messageAddress()), scratch);
      pointer = scratch.pointer();
      block.holds(pointer, Native::mapFini);
    } catch (Throwable failed) {
      net.release();
      throw failed;
    }
  }

  /**
   * Reads a map file.
   *
   * @throws IOException the file cannot be read
   * @throws SpherecloudException it is no map, was changed, or is of another version; the message says what to do
   */
  public static SphereMap open(Path path) throws IOException {
    try (FileChannel file = FileChannel.open(Objects.requireNonNull(path, "path"), StandardOpenOption.READ)) {
      long bytes = file.size();
      if (bytes > Integer.MAX_VALUE) throw new IOException(path + " is larger than 2 GiB; no map is");
      return new SphereMap(bytes, into -> {
        while (into.hasRemaining() && file.read(into) >= 0) {}
      });
    }
  }

  /**
   * A map file that was read already, such as an asset of an app.  The bytes are copied.
   *
   * @throws SpherecloudException it is no map, was changed, or is of another version; the message says what to do
   */
  public static SphereMap of(byte[] file) {
    return of(ByteBuffer.wrap(Objects.requireNonNull(file, "file")));
  }

  /**
   * The same from a buffer of any kind, from its position to its limit, which stay where they are.
   *
   * @throws SpherecloudException it is no map, was changed, or is of another version; the message says what to do
   */
  public static SphereMap of(ByteBuffer file) {
    Objects.requireNonNull(file, "file");
    try {
      return new SphereMap(file.remaining(), into -> into.put(file.duplicate()));
    } catch (IOException impossible) {
      throw new AssertionError(impossible);
    }
  }

  /** What the file says of itself, in a new object. */
  public MapInfo getInfo() {
    MapInfo info = new MapInfo();
    guard.enterShared();
    try {
      Failure.checkStruct(Native.mapGetInfo(pointer, info.address), "MapInfo");
    } finally {
      guard.leaveShared();
      Reference.reachabilityFence(this);
    }
    return info;
  }

  /**
   * The unit direction of a point from the sphere's centre, in the map's frame, in a new array.
   *
   * @throws SpherecloudException {@link Status#E_ARGUMENT}: there is no such point
   */
  public double[] direction(int pointIndex) {
    Scratch scratch = Scratch.mine();
    double[] direction = new double[3];
    guard.enterShared();
    try {
      Failure.check(Native.mapDirection(pointer, pointIndex, scratch.address(0)),
          "There is no point " + Integer.toUnsignedString(pointIndex) + "; info.pointCount says how many there are");
      scratch.get(0, direction);
    } finally {
      guard.leaveShared();
      Reference.reachabilityFence(this);
    }
    return direction;
  }

  /** For a localizer: borrows the map during a call, and its memory for longer where the call succeeds. */
  interface Borrower {
    void borrow(long pointer, Block block);
  }

  void lend(Borrower borrower) {
    guard.enterShared();
    try {
      borrower.borrow(pointer, block);
    } finally {
      guard.leaveShared();
      Reference.reachabilityFence(this);
    }
  }

  /** Ends the use of this object; localizers that have the map keep it. */
  @Override
  public void close() {
    if (guard.close()) net.release();
  }
}
