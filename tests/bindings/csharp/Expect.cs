using System;

internal static class Expect {
  internal static void True(bool holds, string what) {
    if (!holds) throw new Exception(what);
  }

  internal static void Equal<T>(T wanted, T found, string what) {
    if (!Equals(wanted, found)) throw new Exception(what + " is " + Shown(found) + ", not " + Shown(wanted));
  }

  /// <summary>To the last bit.</summary>
  internal static void Numbers(double[] wanted, double[] found, string what) {
    Near(wanted, found, 0, what);
  }

  internal static void Near(double[] wanted, double[] found, double tolerance, string what) {
    Equal(wanted.Length, found.Length, "length of " + what);
    for (int i = 0; i < wanted.Length; ++i)
      True(Math.Abs(wanted[i] - found[i]) <= tolerance, what + "[" + i + "] is " + Shown(found[i]) + ", not " + Shown(wanted[i]));
  }

  /// <summary>Throws exactly T, with the words in its message, and gives it.</summary>
  internal static T Throws<T>(Action action, string words) where T : Exception {
    try {
      action();
    } catch (Exception thrown) {
      True(thrown.GetType() == typeof(T), "threw " + thrown);
      True(thrown.Message.Contains(words), "says '" + thrown.Message + "', without '" + words + "'");
      return (T)thrown;
    }
    throw new Exception("did not throw " + typeof(T).Name + " with '" + words + "'");
  }

  private static string Shown<T>(T value) {
    return value is double ? ((double)(object)value).ToString("R") : "" + value;
  }
}
