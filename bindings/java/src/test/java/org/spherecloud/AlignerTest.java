package org.spherecloud;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

/** Depth as seen from the colour camera. */
public class AlignerTest {
  @Test
  public void alignedImagesAgree() {
    AlignerConfig config = new AlignerConfig();
    Session.setRig(config.getRig());
    Image depth = new Image();
    depth.set(Session.image("depth_00.depth16"), 200, 160, Format.DEPTH16);
    try (Aligner aligner = new Aligner(config)) {
      Aligned aligned = new Aligned(config);
      aligner.process(depth, aligned);
      int measured = 0;
      for (int i = 0; i < 320 * 240; i++) {
        int pixel = aligned.getMask().get(i);
        boolean has = pixel == AlignedPixel.MEASURED.getValue() || pixel == AlignedPixel.FILLED.getValue();
        assertEquals(has, aligned.getDepth().getShort(2 * i) != 0);
        assertEquals(has, aligned.getConfidence().get(i) != 0);
        if (has) measured++;
      }
      assertTrue(measured > 320 * 240 / 2);
      assertThrows(IllegalArgumentException.class, () -> aligner.process(depth, new Aligned(319, 240)));
      depth.set(Session.image("color_00.gray8"), 200, 160, Format.GRAY8);
      SpherecloudException wrong = assertThrows(SpherecloudException.class, () -> aligner.process(depth, aligned));
      assertEquals(Status.E_IMAGE, wrong.getStatus());
      aligner.close();
      assertThrows(IllegalStateException.class, () -> aligner.process(depth, aligned));
    }
  }
}
