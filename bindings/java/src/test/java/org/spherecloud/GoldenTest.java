package org.spherecloud;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.nio.ByteBuffer;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import org.junit.Test;

/** The golden session gives what C found in it, to the last bit. */
public class GoldenTest {
  private static final String[] POSE = {"q_w", "q_x", "q_y", "q_z", "t_x", "t_y", "t_z"};

  @Test
  public void processFindsWhatCFound() {
    try (Localizer localizer = Session.localizer()) {
      Result result = new Result();
      for (Session.Row row : Session.ROWS) {
        compare(row, localizer.process(Session.frame(row), result), result);
        comparePrediction(localizer, row);
      }
    }
    assertTrue(Session.ROWS.size() >= 10);
  }

  /** An image is where the buffer's position is, and may have gaps between its rows. */
  @Test
  public void imagesBeginAtThePosition() {
    Session.Row row = Session.ROWS.get(0);
    byte[] pixels = Session.bytes(row.text("color_file"));
    ByteBuffer wide = ByteBuffer.allocateDirect(100 + 400 * 239 + 320);
    for (int y = 0; y < 240; y++) {
      wide.position(100 + 400 * y);
      wide.put(pixels, 320 * y, 320);
    }
    wide.position(100);
    Frame frame = Session.frame(row);
    frame.getColor().set(wide, 320, 240, 400, Format.GRAY8);
    Result result = new Result();
    try (Localizer localizer = Session.localizer()) {
      compare(row, localizer.process(frame, result), result);
    }
  }

  @Test
  public void whatIsKnownBeforeIsUsed() {
    Result result = new Result();
    Frame frame = Session.frame(Session.ROWS.get(0));
    Prior prior = new Prior();
    frame.setPrior(prior);
    try (Localizer first = Session.localizer(); Localizer guided = Session.localizer()) {
      assertTrue(first.process(frame, result));
      assertFalse(result.isGuided());
      assertTrue(result.has(Event.RELOCALIZED));
      prior.setPose(Session.MAP_ID, result.getCameraFromMap(), 0.02, 0.05);
      prior.setOdometry(new Rigid(), 0.01, 0.01);
      assertEquals(Set.of(PriorPart.POSE, PriorPart.ODOMETRY), prior.getFlags());
      assertTrue(guided.process(frame, result));
      assertTrue(result.isGuided());
      prior.setPose(Session.MAP_ID, result.getCameraFromMap(), 0, 0);
      assertThrows(SpherecloudException.class, () -> guided.process(frame, result));
      prior.clear();
      guided.reset();
      assertTrue(guided.process(frame, result));
      assertTrue(result.getConfidence(1, 1) >= result.getConfidence());
    }
  }

  @Test
  public void twoHalvesFindTheSame() {
    LocalizerConfig config = Session.config();
    try (Localizer localizer = Session.localizer(); Features features = new Features(config)) {
      Result result = new Result();
      for (Session.Row row : Session.ROWS) {
        Frame frame = Session.frame(row);
        localizer.extract(frame, features);
        frame.getColor().clear();
        compare(row, localizer.locate(frame, features, result), result);
      }
    }
  }

  /** What one localizer's features are, read out and put in again, another finds the same by. */
  @Test
  public void featuresGoOutAndIn() {
    LocalizerConfig config = Session.config();
    FeatureArrays arrays = new FeatureArrays(config.getMaxKeypoints());
    Session.Row row = Session.ROWS.get(0);
    Frame frame = Session.frame(row);
    try (Localizer localizer = Session.localizer(); Features found = new Features(config);
        Features set = new Features(config)) {
      localizer.extract(frame, found);
      found.get(arrays);
      assertEquals(row.integer("keypoints"), arrays.getCount());
      assertEquals(Spherecloud.extractorId(), arrays.getExtractor());
      set.set(frame, arrays);
      Result result = new Result();
      compare(row, localizer.locate(frame, set, result), result);
    }
  }

  @Test
  public void severalLocalizersInThreads() throws Exception {
    ExecutorService threads = Executors.newFixedThreadPool(3);
    try (SphereMap map = Session.map()) {
      List<Future<?>> plays = new ArrayList<>();
      for (int i = 0; i < 3; i++) plays.add(threads.submit(() -> play(map)));
      for (Future<?> play : plays) play.get();
    } finally {
      threads.shutdown();
    }
  }

  /** While one thread locates a frame, another extracts the features of the next. */
  @Test
  public void extractRunsBesideLocate() throws Exception {
    ExecutorService extracting = Executors.newSingleThreadExecutor();
    LocalizerConfig config = Session.config();
    try (Localizer localizer = Session.localizer(); Features even = new Features(config);
        Features odd = new Features(config)) {
      Features[] features = {even, odd};
      Frame first = Session.frame(Session.ROWS.get(0));
      Future<?> ready = extracting.submit(() -> localizer.extract(first, even));
      Result result = new Result();
      for (int i = 0; i < Session.ROWS.size(); i++) {
        ready.get();
        if (i + 1 < Session.ROWS.size()) {
          Frame next = Session.frame(Session.ROWS.get(i + 1));
          Features free = features[(i + 1) % 2];
          ready = extracting.submit(() -> localizer.extract(next, free));
        }
        Session.Row row = Session.ROWS.get(i);
        compare(row, localizer.locate(Session.frame(row), features[i % 2], result), result);
      }
    } finally {
      extracting.shutdown();
    }
  }

  private static void play(SphereMap map) {
    try (Localizer localizer = new Localizer(Session.config())) {
      localizer.setMap(Session.MAP_ID, map);
      Result result = new Result();
      for (Session.Row row : Session.ROWS) compare(row, localizer.process(Session.frame(row), result), result);
    }
  }

  static void compare(Session.Row row, boolean localized, Result result) {
    assertEquals(row.integer("status"), localized ? Status.OK.getValue() : Status.NOT_LOCALIZED.getValue());
    assertEquals(row.integer("sequence"), result.getSequence());
    assertEquals(row.time("color_time_ns"), result.getTimeNs());
    assertEquals(Outcome.of(row.integer("outcome")), result.getOutcome());
    assertEquals(State.of(row.integer("state")), result.getState());
    assertEquals(row.integer("keypoints"), result.getKeypoints());
    assertEquals(row.integer("inliers"), result.getInliers());
    assertEquals(row.number("confidence"), result.getConfidence(), 0);
    assertEquals(row.number("covariance_0"), result.getCovariance(0), 0);
    assertEquals(row.number("covariance_35"), result.getCovariance(35), 0);
    assertArrayEquals(row.numbers("", POSE), numbers(result.getCameraFromMap()), 0);
  }

  private static void comparePrediction(Localizer localizer, Session.Row row) {
    Prediction prediction = new Prediction();
    boolean known = localizer.predict(row.time("color_time_ns") + 20_000_000, prediction);
    assertEquals(row.integer("predicted_status"), known ? Status.OK.getValue() : Status.NOT_LOCALIZED.getValue());
    assertArrayEquals(row.numbers("predicted_", POSE), numbers(prediction.getCameraFromMap()), 0);
  }

  static double[] numbers(Rigid rigid) {
    double[] q = rigid.getQuaternionWxyz();
    double[] t = rigid.getTranslationM();
    return new double[] {q[0], q[1], q[2], q[3], t[0], t[1], t[2]};
  }
}
