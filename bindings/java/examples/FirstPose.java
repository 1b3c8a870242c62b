import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import org.spherecloud.CameraModel;
import org.spherecloud.Format;
import org.spherecloud.Frame;
import org.spherecloud.Image;
import org.spherecloud.Localizer;
import org.spherecloud.LocalizerConfig;
import org.spherecloud.Result;
import org.spherecloud.SphereMap;

/** From a map and images to poses: FirstPose FOLDER, which has room.sphc, color_00.gray8, depth_00.depth16 and so on. */
public class FirstPose {
  public static void main(String[] words) throws Exception {
    Path folder = Path.of(words[0]);
    LocalizerConfig config = new LocalizerConfig();
    config.getRig().getColorCamera().set(CameraModel.PINHOLE, 320, 240, 250, 250, 160, 120);
    config.getRig().getDepthCamera().set(CameraModel.PINHOLE, 200, 160, 140, 140, 100, 80);
    config.getRig().getColorFromDepth().setTranslationM(0.04, 0, 0);
    try (SphereMap map = SphereMap.open(folder.resolve("room.sphc")); Localizer localizer = new Localizer(config, map)) {
      Frame frame = new Frame();
      Result result = new Result();
      for (int i = 0; i < 10; i++) {
        frame.setColorTimeNs(1_000_000_000L + 33_000_000L * i);
        frame.setDepthTimeNs(frame.getColorTimeNs());
        frame.getColor().set(read(folder, String.format("color_%02d.gray8", i)), 320, 240, Format.GRAY8);
        frame.getDepth().set(read(folder, String.format("depth_%02d.depth16", i)), 200, 160, Format.DEPTH16);
        if (localizer.process(frame, result)) System.out.println(i + ": " + result.getCameraFromMap());
        else System.out.println(i + ": " + result.getOutcome() + " " + result.getHints());
      }
    }
  }

  private static ByteBuffer read(Path folder, String name) throws Exception {
    return Image.directCopy(Files.readAllBytes(folder.resolve(name)));
  }
}
