package org.spherecloud;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNotEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.lang.reflect.Field;
import java.nio.file.Path;
import java.util.Set;
import org.junit.Assume;
import org.junit.Test;

/** What is generated is that of the library. */
public class LayoutTest {
  /** The committed layouts are those of machines of 64 bits. */
  @Test
  public void offsetsAreThoseOfTheInterface() throws Exception {
    Assume.assumeTrue(Memory.POINTER_BYTES == 8);
    int compared = 0;
    for (Session.Row row : Session.table(Path.of(System.getProperty("spherecloud.layout")))) {
      String field = row.text("field");
      String name = (row.text("struct").substring(5) + "_" + (field.isEmpty() ? "bytes" : field)).toUpperCase();
      try {
        Field slot = Layout.class.getDeclaredField(name);
        slot.setAccessible(true);
        assertEquals(name, row.integer(field.isEmpty() ? "bytes" : "offset"), slot.getInt(null));
        compared++;
      } catch (NoSuchFieldException ofTheOtherHeader) {
        continue;
      }
    }
    assertTrue(compared > 200);
  }

  @Test
  public void constantsHaveTheNamesThatTheLibraryGives() {
    for (Status each : Status.values()) named("SPHC_", each, each.value, Native.statusName(each.value));
    for (Format each : Format.values()) named("SPHC_FORMAT_", each, each.value, Native.formatName(each.value));
    for (Outcome each : Outcome.values()) {
      named("SPHC_OUTCOME_", each, each.value, Native.localizerOutcomeName(each.value));
    }
    for (Convention each : Convention.values()) {
      named("SPHC_CONVENTION_", each, each.value, Native.conventionName(each.value));
    }
    for (Fault each : Fault.values()) assertEquals("SPHC_FAULT_" + each, Native.localizerFaultName(each.bit));
    for (Hint each : Hint.values()) assertEquals("SPHC_HINT_" + each, Native.localizerHintName(each.bit));
  }

  private static void named(String prefix, Enum<?> constant, int value, String name) {
    assertEquals(prefix + (constant.name().equals("UNKNOWN") ? "?" : constant.name()), name);
  }

  @Test
  public void valuesThatNobodyKnowsAreUnknown() {
    assertEquals(Outcome.UNKNOWN, Outcome.of(1000));
    assertEquals(Outcome.LOCALIZED, Outcome.of(0));
    assertEquals(Set.of(Fault.MIRRORED, Fault.DEPTH_RANGE), Fault.of(Fault.MIRRORED.bit | 1 | 1 << 30));
  }

  @Test
  public void anotherReleaseIsRefused() {
    assertNull(Library.check(Release.ABI, Release.VERSION, Release.FINGERPRINT));
    assertTrue(Library.check(Release.ABI, "9.8.7", Release.FINGERPRINT).contains("9.8.7"));
    assertTrue(Library.check(Release.ABI + 1, Release.VERSION, Release.FINGERPRINT).contains("take both"));
    assertNotEquals(null, Library.check(Release.ABI, Release.VERSION, 0));
  }
}
