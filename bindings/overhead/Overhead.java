import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import org.spherecloud.CameraModel;
import org.spherecloud.Format;
import org.spherecloud.Frame;
import org.spherecloud.Image;
import org.spherecloud.Localizer;
import org.spherecloud.LocalizerConfig;
import org.spherecloud.Prediction;
import org.spherecloud.Result;
import org.spherecloud.SphereMap;

/** What overhead.c does, through the binding: a line in, a line with processor times out. */
public class Overhead {
  private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();
  private static final int FRAMES = 10;
  private static final int PREDICTIONS = 1000;
  private final ByteBuffer[] color = new ByteBuffer[FRAMES];
  private final ByteBuffer[] depth = new ByteBuffer[FRAMES];
  private final Frame frame = new Frame();
  private final Result result = new Result();
  private final Prediction prediction = new Prediction();

  private Overhead(Path folder) throws Exception {
    for (int i = 0; i < FRAMES; i++) {
      color[i] = Image.directCopy(Files.readAllBytes(folder.resolve(String.format("color_%02d.gray8", i))));
      depth[i] = Image.directCopy(Files.readAllBytes(folder.resolve(String.format("depth_%02d.depth16", i))));
    }
  }

  private static LocalizerConfig config() {
    LocalizerConfig config = new LocalizerConfig();
    config.getRig().getColorCamera().set(CameraModel.PINHOLE, 320, 240, 250, 250, 160, 120);
    config.getRig().getDepthCamera().set(CameraModel.PINHOLE, 200, 160, 140, 140, 100, 80);
    config.getRig().getColorFromDepth().setTranslationM(0.04, 0, 0);
    return config;
  }

  private void play(Localizer localizer) {
    StringBuilder line = new StringBuilder();
    localizer.reset();
    for (int i = 0; i < FRAMES; i++) {
      long before = THREADS.getCurrentThreadCpuTime();
      frame.setColorTimeNs(1_000_000_000L + 33_000_000L * i);
      frame.setDepthTimeNs(frame.getColorTimeNs());
      frame.getColor().set(color[i], 320, 240, 320, Format.GRAY8);
      frame.getDepth().set(depth[i], 200, 160, 400, Format.DEPTH16);
      localizer.process(frame, result);
      line.append(THREADS.getCurrentThreadCpuTime() - before).append(' ');
    }
    long before = THREADS.getCurrentThreadCpuTime();
    for (int i = 0; i < PREDICTIONS; i++) localizer.predict(frame.getColorTimeNs() + i, prediction);
    System.out.println(line.append((THREADS.getCurrentThreadCpuTime() - before) / PREDICTIONS));
  }

  public static void main(String[] words) throws Exception {
    Path folder = Path.of(words[0]);
    Overhead overhead = new Overhead(folder);
    BufferedReader lines = new BufferedReader(new InputStreamReader(System.in));
    try (SphereMap map = SphereMap.open(folder.resolve("room.sphc")); Localizer localizer = new Localizer(config(), map)) {
      while (lines.readLine() != null) overhead.play(localizer);
    }
  }
}
