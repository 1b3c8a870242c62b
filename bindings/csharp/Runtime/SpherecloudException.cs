using System;

namespace SphereCloud {
/// <summary>A call of the library failed. What the caller handed over is unchanged, and objects can go on.</summary>
public sealed class SpherecloudException : Exception {
  /// <summary>With the library's message.</summary>
  public SpherecloudException(Status status, string explanation)
      : base((explanation.Length > 0 ? explanation : "the call failed") + " [" + status + "]") {
    Status = status;
    Explanation = explanation;
  }

  /// <summary>Which kind of failure it is; docs/errors.md lists cause and cure of each.</summary>
  public Status Status { get; }

  /// <summary>The library's own words: what was wrong, with the values seen, and what to do. May be "".</summary>
  public string Explanation { get; }

  internal static void Check(Status status) {
    if (status < 0) throw new SpherecloudException(status, "");
  }

  internal static unsafe void Check(Status status, ref Native.sphc_message message) {
    if (status >= 0) return;
    fixed (byte* text = message.text) throw new SpherecloudException(status, SphereCloud.Text.Of(text));
  }
}
}
