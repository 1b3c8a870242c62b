package org.spherecloud;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.nio.file.Path;
import java.util.List;
import org.junit.Test;

/** Poses of other systems are those of the golden vectors. */
public class ConventionsTest {
  private static final double[] IDENTITY = {1, 0, 0, 0, 0, 0, 0};
  private static final String[] RIGID = {"_qw", "_qx", "_qy", "_qz", "_x", "_y", "_z"};
  private static final String[] POSE = {"_0", "_1", "_2", "_3", "_4", "_5", "_6"};
  private static final double EXACT = 1e-12;

  @Test
  public void posesAreThoseOfTheGoldenVectors() {
    List<Session.Row> vectors = Session.table(Path.of(System.getenv("SPHERECLOUD_CONVENTIONS")));
    assertTrue(vectors.size() > 60);
    vectors.forEach(ConventionsTest::compare);
  }

  private static void compare(Session.Row row) {
    Convention convention = Convention.valueOf(row.text("convention"));
    Rigid world = row.has("world_from_map_qw") ? rigid(row, "world_from_map") : null;
    Rigid worldOrIdentity = world == null ? new Rigid() : world;
    double[] pose = new double[7];
    Rigid found = new Rigid();
    if (row.has("up_map_x")) {
      compare(GoldenTest.numbers(worldOrIdentity),
          Conventions.makeWorld(convention, row.numbers("up_map", "_x", "_y", "_z")));
    }
    Conventions.writeCamera(convention, world, rigid(row, "camera_from_map"), pose);
    assertArrayEquals(row.numbers("camera_pose", POSE), pose, EXACT);
    Conventions.readCamera(convention, world, row.numbers("camera_pose", POSE), found);
    compare(row.numbers("camera_from_map", RIGID), found);
    Conventions.writeMap(convention, worldOrIdentity, pose);
    assertArrayEquals(row.numbers("map_pose", POSE), pose, EXACT);
    Conventions.readMap(convention, row.numbers("map_pose", POSE), found);
    compare(world == null ? IDENTITY : row.numbers("world_from_map", RIGID), found);
  }

  private static Rigid rigid(Session.Row row, String name) {
    double[] n = row.numbers(name, RIGID);
    return new Rigid(n[0], n[1], n[2], n[3], n[4], n[5], n[6]);
  }

  private static void compare(double[] wanted, Rigid found) {
    assertArrayEquals(wanted, GoldenTest.numbers(found), EXACT);
  }

  @Test
  public void failuresSayWhy() {
    SpherecloudException noWorld = assertThrows(SpherecloudException.class,
        () -> Conventions.writeCamera(Convention.UNITY, null, new Rigid(), new double[7]));
    assertEquals(Status.E_ARGUMENT, noWorld.getStatus());
    assertThrows(SpherecloudException.class, () -> Conventions.makeWorld(Convention.TUM, 0, 0, 0));
    SpherecloudException unknown = assertThrows(SpherecloudException.class,
        () -> Conventions.writeMap(Convention.UNKNOWN, new Rigid(), new double[7]));
    assertEquals(Status.E_UNSUPPORTED, unknown.getStatus());
    assertThrows(IllegalArgumentException.class,
        () -> Conventions.writeMap(Convention.TUM, new Rigid(), new double[6]));
  }

  @Test
  public void rigidTransformsCompose() {
    Rigid a = new Rigid(Math.sqrt(0.5), 0, 0, Math.sqrt(0.5), 1, 2, 3);
    assertArrayEquals(new double[] {1, 3, 3}, a.apply(1, 0, 0), EXACT);
    compare(IDENTITY, a.compose(a.inverse()));
    Rigid copy = a.copy();
    a.setTranslationM(0, 0, 0);
    assertEquals(3, copy.getTranslationM(2), 0);
  }
}
