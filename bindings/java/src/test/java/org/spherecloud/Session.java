package org.spherecloud;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** The golden session: a map, frames, and what C found in them. */
final class Session {
  static final Path FOLDER = Path.of(System.getenv("SPHERECLOUD_GOLDEN"));
  static final List<Row> ROWS = table(FOLDER.resolve("session.csv"));
  static final int MAP_ID;
  private static final Map<String, String> SETUP = new HashMap<>();
  private static final Map<String, ByteBuffer> IMAGES = new HashMap<>();

  static {
    for (Row row : table(FOLDER.resolve("config.csv"))) SETUP.put(row.text("field"), row.text("value"));
    MAP_ID = Integer.parseInt(SETUP.get("map_id"));
  }

  private Session() {}

  /** A row of a CSV file. */
  static final class Row {
    private final Map<String, String> fields = new HashMap<>();

    String text(String field) {
      return fields.get(field);
    }

    boolean has(String field) {
      return fields.containsKey(field) && !text(field).isEmpty();
    }

    int integer(String field) {
      return Integer.parseInt(text(field));
    }

    long time(String field) {
      return Long.parseLong(text(field));
    }

    double number(String field) {
      return Double.parseDouble(text(field));
    }

    double[] numbers(String prefix, String... names) {
      double[] found = new double[names.length];
      for (int i = 0; i < names.length; i++) found[i] = number(prefix + names[i]);
      return found;
    }
  }

  static List<Row> table(Path path) {
    try {
      List<String> lines = Files.readAllLines(path);
      String[] names = lines.get(0).split(",");
      List<Row> rows = new ArrayList<>();
      for (String line : lines.subList(1, lines.size())) {
        String[] values = line.split(",", -1);
        Row row = new Row();
        for (int i = 0; i < names.length; i++) row.fields.put(names[i], values[i]);
        rows.add(row);
      }
      return rows;
    } catch (IOException failed) {
      throw new UncheckedIOException(failed);
    }
  }

  static LocalizerConfig config() {
    LocalizerConfig config = new LocalizerConfig();
    setRig(config.getRig());
    config.setMaxKeypoints(Integer.parseInt(SETUP.get("max_keypoints")));
    config.setDepthSigmaM(Double.parseDouble(SETUP.get("depth_sigma_m")));
    return config;
  }

  static void setRig(Rig rig) {
    List<Row> cameras = table(FOLDER.resolve("cameras.csv"));
    setCamera(rig.getColorCamera(), cameras.get(0));
    setCamera(rig.getDepthCamera(), cameras.get(1));
    rig.getColorFromDepth().setTranslationM(Double.parseDouble(SETUP.get("color_from_depth_x_m")), 0, 0);
  }

  private static void setCamera(Camera camera, Row row) {
    camera.set(CameraModel.of(row.integer("model")), row.integer("width"), row.integer("height"),
        row.numbers("", "fx", "fy", "cx", "cy"));
  }

  static byte[] mapBytes() {
    return bytes("room.sphc");
  }

  static SphereMap map() {
    return SphereMap.of(mapBytes());
  }

  static Localizer localizer() {
    try (SphereMap map = map()) {
      Localizer localizer = new Localizer(config());
      localizer.setMap(MAP_ID, map);
      return localizer;
    }
  }

  static byte[] bytes(String name) {
    try {
      return Files.readAllBytes(FOLDER.resolve(name));
    } catch (IOException failed) {
      throw new UncheckedIOException(failed);
    }
  }

  /** Direct; read once. */
  static synchronized ByteBuffer image(String name) {
    return IMAGES.computeIfAbsent(name, absent -> Image.directCopy(bytes(name)));
  }

  static Frame frame(Row row) {
    Frame frame = new Frame();
    frame.setSequence(row.integer("sequence"));
    frame.setColorTimeNs(row.time("color_time_ns"));
    frame.setDepthTimeNs(row.time("depth_time_ns"));
    frame.getColor().set(image(row.text("color_file")), 320, 240, Format.GRAY8);
    frame.getDepth().set(image(row.text("depth_file")), 200, 160, Format.DEPTH16);
    if (row.integer("has_up") == 1) frame.setPrior(up(row.number("up_sigma_rad")));
    return frame;
  }

  private static Prior up(double sigmaRad) {
    Prior prior = new Prior();
    prior.setUp(MAP_ID, new double[] {0, -1, 0}, new double[] {0, -1, 0}, sigmaRad);
    return prior;
  }
}
