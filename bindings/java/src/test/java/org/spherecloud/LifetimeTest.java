package org.spherecloud;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.lang.management.ManagementFactory;
import java.nio.ByteBuffer;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.locks.LockSupport;
import org.junit.Assume;
import org.junit.Test;

/** Nothing is freed that is in use, nothing is kept that is lost, and a frame makes no garbage. */
public class LifetimeTest {
  private static final Session.Row ROW = Session.ROWS.get(0);

  @Test
  public void whatIsClosedSaysSo() {
    SphereMap map = Session.map();
    Localizer localizer = Session.localizer();
    Features features = new Features(Session.config());
    List.of(map, localizer, features).forEach(LifetimeTest::closeTwice);
    Frame frame = Session.frame(ROW);
    assertThrows(IllegalStateException.class, map::getInfo);
    assertThrows(IllegalStateException.class, localizer::getMapCount);
    assertThrows(IllegalStateException.class, () -> localizer.process(frame, new Result()));
    assertThrows(IllegalStateException.class, () -> localizer.extract(frame, new Features(Session.config())));
    IllegalStateException closed = assertThrows(IllegalStateException.class, () -> features.get(new FeatureArrays(1)));
    assertEquals("The Features object is closed; make a new one", closed.getMessage());
    try (Localizer open = new Localizer(Session.config())) {
      assertThrows(IllegalStateException.class, () -> open.setMap(0, map));
      assertThrows(IllegalStateException.class, () -> open.extract(frame, features));
      assertThrows(IllegalStateException.class, () -> open.locate(frame, features, new Result()));
      assertEquals(0, open.getMapCount());
    }
  }

  private static void closeTwice(AutoCloseable each) {
    try {
      each.close();
      each.close();
    } catch (Exception failed) {
      throw new AssertionError(failed);
    }
  }

  @Test
  public void aMapStaysWhileALocalizerHasIt() {
    collect();
    int before = Block.count();
    Result result = new Result();
    try (Localizer localizer = new Localizer(Session.config())) {
      for (int i = 0; i < 3; i++) { // replaced by itself, and closed each time
        try (SphereMap map = Session.map()) {
          localizer.setMap(Session.MAP_ID, map);
        }
      }
      collect();
      assertEquals(before + 3, Block.count()); // state, scratch and one map
      GoldenTest.compare(ROW, localizer.process(Session.frame(ROW), result), result);
      localizer.removeMap(Session.MAP_ID);
      assertEquals(before + 2, Block.count());
    }
    assertEquals(before, Block.count());
  }

  /** Whatever order the collector finds them in. */
  @Test
  public void whatIsLostIsGivenBack() {
    collect();
    int before = Block.count();
    for (int i = 0; i < 20; i++) Session.localizer().process(Session.frame(ROW), new Result());
    assertTrue(Block.count() > before);
    collect();
    assertTrue(Block.count() + " are left of " + before, Block.count() <= before);
  }

  /** The collector does not see native memory, so it is asked. */
  @Test
  public void whatIsLostDoesNotPileUp() {
    collect();
    LocalizerConfig config = Session.config();
    long before = NativeBytes.taken();
    long most = before;
    try (SphereMap map = Session.map()) {
      for (int i = 0; i < 150; i++) {
        new Localizer(config).setMap(0, map);
        most = Math.max(most, NativeBytes.taken());
      }
    }
    assertTrue(most - before + " bytes", most - before < NativeBytes.BOUND + (NativeBytes.BOUND >> 2));
  }

  @Test
  public void whatIsLostIsGivenBackWhereThereIsNoMemory() {
    collect();
    int before = Block.count();
    for (int i = 0; i < 3; i++) new Localizer(Session.config());
    long taken = NativeBytes.taken();
    assertThrows(OutOfMemoryError.class, () -> new Block(64, 48)); // no machine aligns so
    assertTrue(Block.count() + " are left of " + before, Block.count() <= before);
    assertTrue(NativeBytes.taken() < taken);
    assertThrows(OutOfMemoryError.class, () -> new Block(1L << 60, 64));
  }

  static void collect() {
    for (int i = 0; i < 5; i++) {
      System.gc();
      try {
        Thread.sleep(10);
      } catch (InterruptedException stopped) {
        throw new AssertionError(stopped);
      }
      Net.releaseLost();
    }
  }

  /** Images of which the caller has no buffer any more. */
  @Test
  public void aFrameKeepsItsImages() {
    try (Localizer localizer = Session.localizer()) {
      Frame frame = Session.frame(ROW);
      frame.getColor().set(Image.directCopy(Session.bytes(ROW.text("color_file"))), 320, 240, Format.GRAY8);
      collect();
      Result result = new Result();
      GoldenTest.compare(ROW, localizer.process(frame, result), result);
    }
  }

  /** As the planes of Android after Image.close; Java 22 has such buffers too. */
  @Test
  public void imagesWhoseMemoryWasGivenBack() throws Exception {
    Assume.assumeTrue(Runtime.version().feature() >= 22);
    Class<?> type = Class.forName("java.lang.foreign.Arena");
    AutoCloseable arena = (AutoCloseable) type.getMethod("ofShared").invoke(null);
    Object segment = type.getMethod("allocate", long.class).invoke(arena, 320L * 240);
    Object buffer = Class.forName("java.lang.foreign.MemorySegment").getMethod("asByteBuffer").invoke(segment);
    try (Localizer localizer = Session.localizer(); Features features = new Features(Session.config())) {
      Frame frame = Session.frame(ROW);
      frame.getColor().set((ByteBuffer) buffer, 320, 240, Format.GRAY8);
      localizer.process(frame, new Result());
      Frame ofDepth = new Frame(0, 1);
      ofDepth.getColor().set(Session.image(ROW.text("color_file")), 320, 240, Format.GRAY8);
      ofDepth.getDepthView(0).getDepth().set((ByteBuffer) buffer, 200, 160, Format.DEPTH16);
      arena.close();
      assertThrows(IllegalStateException.class, () -> localizer.process(frame, new Result()));
      assertThrows(IllegalStateException.class, () -> localizer.extract(frame, features));
      assertThrows(IllegalStateException.class, () -> features.set(frame, new FeatureArrays(0)));
      assertThrows(IllegalStateException.class, () -> localizer.locate(ofDepth, features, new Result()));
      localizer.extract(ofDepth, features); // which reads no depth
      features.set(ofDepth, new FeatureArrays(0));
    }
  }

  /** Calls and ends from many threads: each call is done or refused, and none crashes. */
  @Test
  public void endsAtAnyTime() throws Exception {
    Frame[] frames = {Session.frame(ROW), Session.frame(ROW), Session.frame(ROW)};
    for (int round = 0; round < 5; round++) {
      Localizer localizer = Session.localizer();
      Features features = new Features(Session.config());
      List<Thread> threads = new ArrayList<>();
      threads.add(new Thread(() -> untilRefused(() -> localizer.process(frames[0], new Result()))));
      threads.add(new Thread(() -> untilRefused(() -> localizer.extract(frames[1], features))));
      threads.add(new Thread(() -> untilRefused(() -> localizer.locate(frames[2], features, new Result()))));
      threads.forEach(Thread::start);
      while (!closed(localizer) || !closed(features)) Thread.onSpinWait();
      for (Thread thread : threads) thread.join();
    }
  }

  private static void untilRefused(Runnable call) {
    while (true) {
      try {
        LockSupport.parkNanos(5_000_000); // so that the object is free now and then
        call.run();
      } catch (IllegalStateException refused) {
        if (refused.getMessage().contains("closed")) return;
      } catch (SpherecloudException ofNoFrameYet) {
        assertEquals(Status.E_STATE, ofNoFrameYet.getStatus());
      }
    }
  }

  private static boolean closed(AutoCloseable each) throws Exception {
    try {
      each.close();
      return true;
    } catch (IllegalStateException inUse) {
      return false;
    }
  }

  @Test
  public void theLogHearsAndItsExceptionComesOut() {
    List<String> lines = new ArrayList<>();
    LocalizerConfig config = Session.config();
    config.setLog(LogLevel.DEBUG, (level, text) -> lines.add(level + ": " + text));
    try (SphereMap map = Session.map(); Localizer localizer = new Localizer(config, map)) {
      localizer.process(Session.frame(ROW), new Result());
    }
    assertFalse(lines.isEmpty());
    RuntimeException mine = new RuntimeException("of the log");
    config.setLog(LogLevel.DEBUG, (level, text) -> {
      lines.add(text);
      throw mine;
    });
    lines.clear();
    try (SphereMap map = Session.map(); Localizer localizer = new Localizer(config, map)) {
      assertSame(mine, assertThrows(RuntimeException.class,
          () -> localizer.process(Session.frame(ROW), new Result())));
    }
    assertEquals(1, lines.size()); // none is called with an exception on its way
  }

  /** From within a call, and at the same time from another thread. */
  @Test
  public void aSecondCallAtTheSameTimeIsRefused() throws Exception {
    Localizer[] mine = new Localizer[1];
    Features features = new Features(Session.config());
    List<RuntimeException> refusals = new ArrayList<>();
    CountDownLatch asked = new CountDownLatch(1);
    LocalizerConfig config = Session.config();
    config.setLog(LogLevel.DEBUG, (level, text) -> {
      if (mine[0] == null) return;
      refusals.add(assertThrows(IllegalStateException.class, mine[0]::reset));
      refusals.add(assertThrows(IllegalStateException.class, mine[0]::close));
      refusals.add(assertThrows(IllegalStateException.class, () -> mine[0].extract(Session.frame(ROW), features)));
      Thread other = new Thread(() -> {
        refusals.add(assertThrows(IllegalStateException.class, mine[0]::getMapCount));
        asked.countDown();
      });
      other.start();
      try {
        asked.await();
      } catch (InterruptedException stopped) {
        throw new AssertionError(stopped);
      }
    });
    try (SphereMap map = Session.map(); Localizer localizer = new Localizer(config, map)) {
      mine[0] = localizer;
      assertTrue(localizer.process(Session.frame(ROW), new Result()));
      assertTrue(refusals.size() >= 4);
      mine[0] = null;
    }
  }

  @Test
  public void stageTimesComeFromTheClock() {
    Result result = new Result();
    try (Localizer localizer = Session.localizer()) {
      localizer.process(Session.frame(ROW), result);
      assertTrue(result.getFeaturesUs() > 0);
    }
    long[] now = {0};
    LocalizerConfig config = Session.config();
    config.setClock(() -> now[0] += 1_000_000_000);
    try (SphereMap map = Session.map(); Localizer localizer = new Localizer(config, map)) {
      Frame frame = Session.frame(ROW);
      localizer.process(frame, result);
      assertEquals(0, result.getFeaturesUs() % 1_000_000);
      frame.setColorTimeNs(frame.getColorTimeNs() + 1);
      frame.setDeadlineUs(10);
      assertFalse(localizer.process(frame, result));
      assertEquals(Outcome.DEADLINE, result.getOutcome());
      assertTrue(result.has(Cut.FEATURES));
    }
  }

  @Test
  public void aFrameMakesNoGarbage() {
    var threads = (com.sun.management.ThreadMXBean) ManagementFactory.getThreadMXBean();
    try (Localizer localizer = Session.localizer(); Features features = new Features(Session.config())) {
      Frame frame = Session.frame(ROW);
      Result result = new Result();
      Prediction prediction = new Prediction();
      ByteBuffer color = Session.image(ROW.text("color_file"));
      long bytes = 0;
      for (int i = 0; i < 60; i++) {
        if (i == 30) bytes = threads.getThreadAllocatedBytes(Thread.currentThread().getId());
        frame.setColorTimeNs(1_000_000_000L + 33_000_000L * i);
        frame.getColor().set(color, 320, 240, 320, Format.GRAY8);
        if (i % 2 == 0) {
          localizer.process(frame, result);
        } else {
          localizer.extract(frame, features);
          localizer.locate(frame, features, result);
        }
        localizer.predict(frame.getColorTimeNs(), prediction);
        assertTrue(result.getOutcome() == Outcome.LOCALIZED && result.getConfidence() > 0);
      }
      long made = threads.getThreadAllocatedBytes(Thread.currentThread().getId()) - bytes;
      assertEquals(0, made);
    }
  }
}
