using System;

namespace SphereCloud {
/// <summary>A call of the library failed. What the caller handed over is unchanged, and objects can go on.</summary>
public sealed class SpherecloudException : Exception {
  /// <summary>With the library's message.</summary>
  public SpherecloudException(Status status, string explanation)
      : base((explanation.Length > 0 ? explanation : Unexplained) + " [" + status + "]") {
    Status = status;
    Explanation = explanation;
  }

  /// <summary>Which kind of failure it is; docs/errors.md lists cause and cure of each.</summary>
  public Status Status { get; }

  /// <summary>What was wrong, with the values seen, and what to do: the library's own words, or those of this assembly
  /// for calls to which the library adds none. "" for a few calls that fail only by a defect.</summary>
  public string Explanation { get; }

  private const string Unexplained = "the call failed, for a reason that docs/errors.md lists";

  internal static void Check(Status status) {
    if (status < 0) throw new SpherecloudException(status, "");
  }

  internal static unsafe void Check(Status status, ref Native.sphc_message message) {
    if (status >= 0) return;
    fixed (byte* text = message.text) throw new SpherecloudException(status, SphereCloud.Text.Of(text));
  }
}
}
