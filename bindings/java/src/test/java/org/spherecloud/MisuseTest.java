package org.spherecloud;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.nio.ByteBuffer;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import org.junit.Test;
import org.junit.function.ThrowingRunnable;

/** What is wrong is refused with a reason, and never by a crash. */
public class MisuseTest {
  private static void fails(Status status, String word, ThrowingRunnable call) {
    SpherecloudException failure = assertThrows(SpherecloudException.class, call);
    assertEquals(failure.getMessage(), status, failure.getStatus());
    assertTrue(failure.getMessage(), failure.getMessage().contains(word));
  }

  private static void illegal(String word, ThrowingRunnable call) {
    IllegalArgumentException failure = assertThrows(IllegalArgumentException.class, call);
    assertTrue(failure.getMessage(), failure.getMessage().contains(word));
  }

  @Test
  public void mapsThatAreNone() {
    byte[] map = Session.mapBytes();
    fails(Status.E_MAP_FORMAT, "", () -> SphereMap.of(java.util.Arrays.copyOf(map, map.length / 2)));
    fails(Status.E_MAP_FORMAT, "", () -> SphereMap.of(new byte[0]));
    byte[] flipped = map.clone();
    flipped[map.length / 2] ^= 1;
    fails(Status.E_MAP_CHECKSUM, "", () -> SphereMap.of(flipped));
    assertThrows(NoSuchFileException.class, () -> SphereMap.open(Path.of("no such map.sphc")));
    assertThrows(NullPointerException.class, () -> SphereMap.of((byte[]) null));
  }

  @Test
  public void mapsTellOfThemselves() throws Exception {
    byte[] bytes = Session.mapBytes();
    ByteBuffer within = ByteBuffer.allocateDirect(bytes.length + 7).position(7).put(bytes).position(7);
    try (SphereMap map = SphereMap.open(Session.FOLDER.resolve("room.sphc")); SphereMap same = SphereMap.of(within)) {
      MapInfo info = map.getInfo();
      assertEquals(bytes.length, info.getFileBytes());
      assertEquals(Band.VISIBLE, info.getBand());
      org.junit.Assert.assertArrayEquals(info.getMapId(), same.getInfo().getMapId());
      double[] d = map.direction(info.getPointCount() - 1);
      assertEquals(1, d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1e-6);
      fails(Status.E_ARGUMENT, "pointCount", () -> map.direction(info.getPointCount()));
    }
    assertEquals(7, within.position());
  }

  @Test
  public void sizesOfImagesThatCannotBe() {
    ByteBuffer pixels = ByteBuffer.allocateDirect(64);
    Image image = new Image();
    illegal("The width of a camera's image is -5", () -> new Camera(CameraModel.PINHOLE, -5, 480, 1, 1, 1, 1));
    illegal("The height of a camera's image is -1", () -> new Camera().setHeight(-1));
    illegal("No image is -5 x 8 pixels", () -> image.set(pixels, -5, 8, Format.GRAY8));
    illegal("No image is 8 x 0 pixels", () -> image.set(pixels, 8, 0, 8, Format.GRAY8));
    illegal("No image of GRAY10P is 7 pixels wide", () -> image.set(pixels, 7, 1, Format.GRAY10P));
    illegal("stride of 7 bytes, and a row of 8 pixels GRAY8 has 8", () -> image.set(pixels, 8, 8, 7, Format.GRAY8));
    fails(Status.E_ARGUMENT, "width is 0", () -> new Camera(CameraModel.PINHOLE, 0, 480, 1, 1, 1, 1).check());
  }

  @Test
  public void rigsThatCannotBe() {
    LocalizerConfig config = Session.config();
    config.getRig().getColorFromDepth().setTranslationM(Double.NaN, 0, 0);
    fails(Status.E_ARGUMENT, "color_from_depth", () -> new Localizer(config));
    fails(Status.E_ARGUMENT, "color_from_depth", () -> new Features(config));
    fails(Status.E_ARGUMENT, "color_from_depth", () -> config.getRig().check());
    fails(Status.E_ARGUMENT, "", () -> new Aligner(new AlignerConfig()));
    fails(Status.E_ARGUMENT, "max_maps", () -> {
      LocalizerConfig other = Session.config();
      other.setMaxMaps(0);
      new Localizer(other);
    });
    illegal("13 parameters", () -> new Camera(CameraModel.BROWN8, 640, 480, new double[13]));
    assertThrows(NullPointerException.class, () -> new Localizer(null));
  }

  @Test
  public void camerasProjectAndBack() {
    Camera camera = new Camera(CameraModel.KANNALA_BRANDT4, 640, 480, 300, 300, 320, 240, 0.1, 0.01, 0, 0);
    camera.check();
    double[] bearing = new double[3];
    double[] pixel = new double[2];
    assertTrue(camera.unproject(new double[] {100, 200}, bearing));
    assertTrue(camera.project(bearing, pixel));
    org.junit.Assert.assertArrayEquals(new double[] {100, 200}, pixel, 1e-6);
    assertFalse(camera.project(new double[] {0, 0, -1}, pixel));
    illegal("3 are needed", () -> camera.project(new double[2], pixel));
    fails(Status.E_ARGUMENT, "", () -> new Camera().project(new double[3], pixel));
  }

  @Test
  public void imagesThatAreTooSmallOrElsewhere() {
    Image image = new Image();
    ByteBuffer small = ByteBuffer.allocateDirect(320 * 240 - 1);
    illegal("76799", () -> image.set(small, 320, 240, Format.GRAY8));
    illegal("heap", () -> image.set(ByteBuffer.allocate(320 * 240), 320, 240, Format.GRAY8));
    illegal("stride", () -> image.set(small, 320, 200, 319, Format.GRAY8));
    illegal("No image", () -> image.set(small, 320, -1, Format.GRAY8));
    illegal("UNKNOWN", () -> image.set(small, 320, 200, Format.UNKNOWN));
    illegal("bytes", () -> image.set(small, 1 << 20, 1 << 20, Format.GRAY8));
    assertThrows(NullPointerException.class, () -> image.set(null, 320, 240, Format.GRAY8));
    image.set(ByteBuffer.allocateDirect(400 * 239 + 320), 320, 240, 400, Format.GRAY8); // as the planes of Camera2
  }

  @Test
  public void framesThatDoNotFit() {
    Session.Row row = Session.ROWS.get(0);
    try (Localizer localizer = Session.localizer()) {
      Result result = new Result();
      fails(Status.E_IMAGE, "", () -> localizer.process(new Frame(), result));
      Frame small = Session.frame(row);
      small.getColor().set(ByteBuffer.allocateDirect(160 * 120), 160, 120, Format.GRAY8);
      fails(Status.E_IMAGE, "160", () -> localizer.process(small, result));
      Frame withViews = new Frame(1);
      fails(Status.E_ARGUMENT, "view", () -> {
        Frame frame = Session.frame(row);
        withViews.getColor().set(Session.image(row.text("color_file")), 320, 240, Format.GRAY8);
        withViews.getDepth().set(Session.image(row.text("depth_file")), 200, 160, Format.DEPTH16);
        localizer.process(withViews, result);
      });
      assertThrows(NullPointerException.class, () -> localizer.process(null, result));
      assertThrows(NullPointerException.class, () -> localizer.process(small, null));
      GoldenTest.compare(row, localizer.process(Session.frame(row), result), result);
    }
  }

  @Test
  public void mapsAndParametersOfALocalizer() {
    LocalizerConfig config = Session.config();
    config.setMaxMaps(1);
    try (SphereMap map = Session.map(); Localizer localizer = new Localizer(config, map)) {
      fails(Status.E_CAPACITY, "", () -> localizer.setMap(1, map));
      fails(Status.E_ARGUMENT, "", () -> localizer.removeMap(99));
      fails(Status.E_ARGUMENT, "", () -> localizer.setMapTransform(99, new Rigid(), 0, 0));
      localizer.setMapTransform(0, new Rigid(), 0.01, 0.1);
      localizer.setMapTransform(0, null, 0, 0);
      localizer.removeMap(0);
      assertEquals(0, localizer.getMapCount());
      ParameterRange range = Localizer.parameterRange(Parameter.PROBES);
      assertTrue(range.isWhole());
      assertEquals(range.getInitial(), localizer.getParameter(Parameter.PROBES), 0);
      fails(Status.E_ARGUMENT, "", () -> localizer.setParameter(Parameter.PROBES, range.getHighest() + 1));
      localizer.setParameter(Parameter.PROBES, range.getLowest());
      assertEquals(range.getLowest(), localizer.getParameter(Parameter.PROBES), 0);
      fails(Status.E_UNSUPPORTED, "", () -> localizer.setParameter(Parameter.UNKNOWN, 1));
      fails(Status.E_ARGUMENT, "", () -> localizer.setDepthBias(new DepthBias()));
    }
  }

  @Test
  public void aMapOfAnotherBand() {
    LocalizerConfig config = Session.config();
    config.setColorBand(Band.INFRARED);
    try (SphereMap map = Session.map()) {
      int before = Block.count();
      fails(Status.E_ARGUMENT, "band", () -> new Localizer(config, map));
      assertEquals(before, Block.count());
    }
  }

  @Test
  public void arraysThatAreTooSmall() {
    LocalizerConfig config = Session.config();
    Frame frame = Session.frame(Session.ROWS.get(0));
    try (Localizer localizer = Session.localizer(); Features features = new Features(config)) {
      fails(Status.E_STATE, "", () -> features.get(new FeatureArrays(400)));
      fails(Status.E_STATE, "", () -> localizer.locate(frame, features, new Result()));
      localizer.extract(frame, features);
      fails(Status.E_CAPACITY, "400", () -> features.get(new FeatureArrays(399)));
      fails(Status.E_CAPACITY, "", () -> new FeatureArrays(2).setCount(3));
      FeatureArrays many = new FeatureArrays(401);
      many.setCount(401);
      fails(Status.E_CAPACITY, "", () -> features.set(frame, many));
      Observations few = new Observations(10);
      assertEquals(0, localizer.observations(few));
      assertTrue(localizer.process(frame, new Result()));
      assertEquals(400, localizer.observations(few));
      assertEquals(10, few.getFilled().size());
      assertTrue(few.getFilled().get(9).getScalePx() > 0);
      assertThrows(IndexOutOfBoundsException.class, () -> few.getFilled().get(10));
      Hypotheses hypotheses = new Hypotheses();
      assertTrue(localizer.hypotheses(hypotheses) > 0);
      assertEquals(Session.MAP_ID, hypotheses.getFilled().get(0).getMapId());
    }
  }

  @Test
  public void sizesThatCannotBe() {
    illegal("33554432 elements", () -> new FeatureArrays(33554432)); // of 128 bytes: 0 in 32 bits
    illegal("-1 elements", () -> new FeatureArrays(-1));
    illegal("-1 elements", () -> new Frame(-1));
    illegal("-1 elements", () -> new Frame(0, -1));
    illegal("elements", () -> new Frame(Integer.MAX_VALUE));
    illegal("elements", () -> new Observations(Integer.MAX_VALUE));
    illegal("-1 x -1", () -> new Aligned(-1, -1));
    illegal("65536 x 65536", () -> new Aligned(65536, 65536));
    illegal("0 x 0", () -> new Aligned(new AlignerConfig()));
    assertEquals(0, Memory.allocate(-1, 64));
    assertEquals(0, Memory.allocate(Long.MIN_VALUE, 64));
  }

  @Test
  public void aNewResultSaysNothing() {
    Result result = new Result();
    assertEquals(Outcome.UNKNOWN, result.getOutcome());
    assertEquals(Limits.MAP_NONE, result.getMapId());
    assertEquals(0, result.getConfidence(), 0);
    assertEquals(0, result.getConfidence(1, 1), 0);
    assertTrue(result.toString(), result.toString().startsWith("UNKNOWN"));
  }

  /** Calls that leave no message do not say what an earlier call left. */
  @Test
  public void aMessageIsOfItsOwnCall() {
    try (Localizer localizer = Session.localizer()) {
      fails(Status.E_IMAGE, "color", () -> localizer.process(new Frame(), new Result()));
      fails(Status.E_UNSUPPORTED, "no parameter UNKNOWN;", () -> localizer.getParameter(Parameter.UNKNOWN));
      fails(Status.E_UNSUPPORTED, "no parameter UNKNOWN;", () -> Localizer.parameterRange(Parameter.UNKNOWN));
      fails(Status.E_UNSUPPORTED, "parameter", () -> localizer.setParameter(Parameter.UNKNOWN, 1));
    }
  }

  private static void missing(String name, ThrowingRunnable call) {
    assertEquals(name, assertThrows(NullPointerException.class, call).getMessage());
  }

  @Test
  public void nullsAreNamed() {
    Image image = new Image();
    ByteBuffer bytes = ByteBuffer.allocateDirect(16);
    missing("data", () -> image.set(null, 4, 4, Format.GRAY8));
    missing("format", () -> image.set(bytes, 4, 4, null));
    missing("format", () -> image.set(bytes, 4, 4, 4, null));
    missing("bytes", () -> Image.directCopy(null));
    missing("path", () -> SphereMap.open(null));
    missing("file", () -> SphereMap.of((byte[]) null));
    missing("file", () -> SphereMap.of((ByteBuffer) null));
    missing("config", () -> new Localizer(null));
    missing("config", () -> new Features(null));
    missing("config", () -> new Aligner(null));
    missing("config", () -> new Aligned(null));
    missing("model", () -> new Camera(null, 4, 4));
    missing("params", () -> new Camera(CameraModel.PINHOLE, 4, 4, (double[]) null));
    missing("pointM", () -> new Camera().project(null, new double[2]));
    missing("other", () -> new Rigid().set(null));
    missing("bFromA", () -> new Rigid().compose(null));
    missing("values", () -> new Rigid().setTranslationM((double[]) null));
    missing("upMap", () -> new Prior().setUp(0, new double[3], null, 1));
    missing("cameraFromMap", () -> new Prior().setPose(0, null, 1, 1));
    missing("convention", () -> Conventions.makeWorld(null, 0, 0, 1));
    missing("cameraFromMap", () -> Conventions.writeCamera(Convention.TUM, null, null, new double[7]));
    missing("pose", () -> Conventions.readMap(Convention.TUM, null, new Rigid()));
    missing("mode", () -> Session.config().setMode(null));
    missing("level", () -> Session.config().setLog(null, null));
    missing("fault", () -> new Result().has((Fault) null));
    missing("parameter", () -> Localizer.parameterRange(null));
  }

  @Test
  public void nullsOfALocalizerAreNamed() {
    Frame frame = new Frame();
    try (Localizer localizer = Session.localizer(); Features features = new Features(Session.config())) {
      missing("map", () -> localizer.setMap(1, null));
      missing("map", () -> new Localizer(Session.config(), null));
      missing("frame", () -> localizer.process(null, new Result()));
      missing("result", () -> localizer.process(frame, null));
      missing("features", () -> localizer.extract(frame, null));
      missing("features", () -> localizer.locate(frame, null, new Result()));
      missing("prediction", () -> localizer.predict(0, null));
      missing("into", () -> localizer.observations(null));
      missing("into", () -> localizer.hypotheses(null));
      missing("parameter", () -> localizer.getParameter(null));
      missing("depth", () -> localizer.setDepthBias(null));
      missing("arrays", () -> features.get(null));
      missing("frame", () -> features.set(null, new FeatureArrays(1)));
      assertEquals(1, localizer.getMapCount()); // none of them left it in use
    }
  }

  @Test
  public void numbersOfAnArray() {
    Rigid rigid = new Rigid();
    assertThrows(IndexOutOfBoundsException.class, () -> rigid.getTranslationM(3));
    illegal("3 are needed", () -> rigid.setTranslationM(1, 2));
  }
}
