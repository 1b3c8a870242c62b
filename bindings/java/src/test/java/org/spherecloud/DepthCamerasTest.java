package org.spherecloud;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.nio.ByteBuffer;
import org.junit.Test;

/** A second depth camera of a rig, and the first as it is in a frame. */
public class DepthCamerasTest {
  private static final Session.Row ROW = Session.ROWS.get(0);
  private static final ByteBuffer BLIND = ByteBuffer.allocateDirect(2 * 200 * 160);

  private final LocalizerConfig config = Session.config();
  private final Result result = new Result();

  /** A rig whose second depth camera is as the first. */
  private Localizer localizer(int amplitudeMin) {
    DepthCamera second = new DepthCamera();
    second.getCamera().set(config.getRig().getDepthCamera());
    second.getColorFromDepth().set(config.getRig().getColorFromDepth());
    second.setAmplitudeMin(amplitudeMin);
    config.setDepthCameras(second);
    second.getCamera().setWidth(1); // was copied
    try (SphereMap map = Session.map()) {
      return new Localizer(config, map);
    }
  }

  /** The first depth camera is blind, and the second sees what it saw. */
  private Frame frame() {
    Frame frame = new Frame(config.getCameraCount(), config.getDepthCameraCount());
    frame.setColorTimeNs(ROW.time("color_time_ns"));
    frame.setDepthTimeNs(ROW.time("depth_time_ns"));
    frame.getColor().set(Session.image(ROW.text("color_file")), 320, 240, Format.GRAY8);
    frame.getDepth().set(BLIND, 200, 160, Format.DEPTH16);
    frame.getDepthView(0).setTimeNs(frame.getDepthTimeNs());
    frame.getDepthView(0).getDepth().set(Session.image(ROW.text("depth_file")), 200, 160, Format.DEPTH16);
    return frame;
  }

  private void refused(Localizer localizer, Frame frame, String words) {
    SpherecloudException refused = assertThrows(SpherecloudException.class, () -> localizer.process(frame, result));
    assertTrue(refused.getMessage(), refused.getMessage().contains(words));
  }

  @Test
  public void theSecondSeesWhereTheFirstIsBlind() {
    try (Localizer localizer = localizer(0)) {
      Frame frame = frame();
      DepthView view = frame.getDepthView(0);
      assertTrue(localizer.process(frame, result));
      view.setCamera(config.getRig().getDepthCamera());
      view.setColorFromDepth(config.getRig().getColorFromDepth());
      assertSame(config.getRig().getDepthCamera(), view.getCamera());
      assertSame(config.getRig().getColorFromDepth(), view.getColorFromDepth());
      frame.setColorTimeNs(frame.getColorTimeNs() + 1);
      assertTrue(localizer.process(frame, result));
      view.setCamera(config.getRig().getColorCamera());
      refused(localizer, frame, "frame.depth_views[i].camera");
      view.setCamera(null);
      view.getDepth().clear();
      frame.setColorTimeNs(frame.getColorTimeNs() + 1);
      assertFalse(localizer.process(frame, result));
    }
    config.setDepthCameras();
    assertEquals(0, config.getDepthCameraCount());
  }

  @Test
  public void viewsThatDoNotFitAreRefused() {
    try (Localizer localizer = localizer(0)) {
      Frame frame = frame();
      frame.getDepthView(0).getDepth().set(BLIND, 200, 159, Format.DEPTH16);
      refused(localizer, frame, "159");
      refused(localizer, Session.frame(ROW), "frame.depth_view_count is 0");
    }
    try (Localizer localizer = localizer(10)) {
      Frame frame = frame();
      refused(localizer, frame, "amplitude");
      frame.getDepthView(0).getAmplitude().set(BLIND, 200, 160, Format.GRAY8);
      assertFalse(localizer.process(frame, result));
    }
  }

  @Test
  public void theLibraryHasDefaults() {
    DepthCamera made = new DepthCamera();
    assertEquals(0.001, made.getUnitM(), 0);
    assertEquals(config.getDepthMinM(), made.getMinM(), 0);
    assertEquals(config.getDepthMaxM(), made.getMaxM(), 0);
  }

  @Test
  public void theFirstAsItIsInAFrame() {
    try (Localizer localizer = Session.localizer()) {
      Frame frame = Session.frame(ROW);
      assertNull(frame.getDepthCamera());
      frame.setDepthCamera(config.getRig().getDepthCamera());
      assertSame(config.getRig().getDepthCamera(), frame.getDepthCamera());
      assertTrue(localizer.process(frame, result));
      frame.setDepthCamera(config.getRig().getColorCamera());
      refused(localizer, frame, "frame.depth_camera");
    }
  }
}
