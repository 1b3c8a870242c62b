package org.spherecloud;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.nio.ByteBuffer;
import java.util.Arrays;
import org.junit.Test;
import org.junit.function.ThrowingRunnable;

/** A further camera of a rig. */
public class RigTest {
  /** It stands where the colour camera stands and sees the same, so the keypoints are of both. */
  @Test
  public void aFurtherCameraIsLookedAt() {
    LocalizerConfig config = Session.config();
    config.setMaxKeypoints(800);
    RigCamera second = new RigCamera();
    second.getCamera().set(config.getRig().getColorCamera());
    config.setCameras(second);
    second.getCamera().setWidth(1); // was copied
    Session.Row row = Session.ROWS.get(0);
    try (SphereMap map = Session.map(); Localizer localizer = new Localizer(config, map)) {
      Frame frame = new Frame(config.getCameraCount());
      frame.setColorTimeNs(row.time("color_time_ns"));
      frame.setDepthTimeNs(row.time("depth_time_ns"));
      frame.getColor().set(Session.image(row.text("color_file")), 320, 240, Format.GRAY8);
      frame.getDepth().set(Session.image(row.text("depth_file")), 200, 160, Format.DEPTH16);
      frame.getView(0).setTimeNs(row.time("color_time_ns"));
      frame.getView(0).getImage().set(Session.image(row.text("color_file")), 320, 240, Format.GRAY8);
      Result result = new Result();
      assertTrue(localizer.process(frame, result));
      Observations observations = new Observations(800);
      localizer.observations(observations);
      assertTrue(observations.getFilled().stream().anyMatch(each -> each.getCamera() == 1));
      frame.getView(0).setCamera(config.getRig().getColorCamera());
      frame.getView(0).setColorFromCamera(new Rigid());
      frame.setColorCamera(config.getRig().getColorCamera());
      frame.setColorFromDepth(config.getRig().getColorFromDepth());
      frame.setColorTimeNs(frame.getColorTimeNs() + 1);
      assertTrue(localizer.process(frame, result));
      frame.setColorCamera(new Camera());
      assertThrows(SpherecloudException.class, () -> localizer.process(frame, result));
      frame.setColorCamera(null);
      frame.getView(0).getImage().clear();
      assertTrue(localizer.process(frame, result));
      assertNull(frame.getColorCamera());
    }
    config.setCameras();
    assertEquals(0, config.getCameraCount());
  }

  /** The list from before is still there, and so is its memory. */
  @Test
  public void aListWithANullChangesNothing() {
    LocalizerConfig config = Session.config();
    RigCamera second = new RigCamera();
    second.getCamera().set(config.getRig().getColorCamera());
    DepthCamera depth = new DepthCamera();
    depth.getCamera().set(config.getRig().getDepthCamera());
    config.setCameras(second);
    config.setDepthCameras(depth);
    refused("cameras[1]", () -> config.setCameras(second, null));
    refused("depthCameras[0]", () -> config.setDepthCameras((DepthCamera) null));
    refused("cameras", () -> config.setCameras((RigCamera[]) null));
    assertEquals(1, config.getCameraCount());
    assertEquals(1, config.getDepthCameraCount());
    LifetimeTest.collect();
    ByteBuffer[] overwriting = new ByteBuffer[100];
    for (int i = 0; i < overwriting.length; i++) {
      byte[] ones = new byte[i % 2 == 0 ? Layout.LOCALIZER_CAMERA_BYTES : Layout.LOCALIZER_DEPTH_CAMERA_BYTES];
      Arrays.fill(ones, (byte) -1);
      overwriting[i] = Image.directCopy(ones);
    }
    new Localizer(config).close();
    assertEquals(100, overwriting.length);
  }

  private static void refused(String words, ThrowingRunnable call) {
    NullPointerException refusal = assertThrows(NullPointerException.class, call);
    assertTrue(refusal.getMessage(), refusal.getMessage().startsWith(words));
  }
}
